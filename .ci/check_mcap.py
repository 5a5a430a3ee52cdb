#!/usr/bin/env python3
"""Recordings against readers and writers that are not ours: PyPI mcap, mcap-protobuf-support, mcap-ros2-support.

usage: check_mcap.py DIR_OF_EXECUTABLES

1. Every message of a log written by `drive --record` is decoded.
2. Frames written by mcap-ros2-support (and by hand as ROS 1) give, through
   `perceive`, the detections of the same frames as JSON lines and PNG files.
3. `drive` is killed at ten moments: at most the last second is missing, and
   `--recover` reads the rest.
"""

import collections
import json
import math
import random
import signal
import struct
import subprocess
import sys
import tempfile
import zlib
from pathlib import Path

from mcap.reader import make_reader
from mcap.records import Channel, Chunk, Message
from mcap.stream_reader import StreamReader
from mcap.writer import Writer
from mcap_protobuf.decoder import DecoderFactory
from mcap_ros2.writer import Writer as Ros2Writer

BIN = Path(sys.argv[1]).resolve()
SENTENCE = "the mug is in the bedroom on the table next to the chairs\n"


def run(*command, stdin=b"", code=0):
    done = subprocess.run([BIN / command[0], *command[1:]], input=stdin, capture_output=True)
    assert done.returncode == code, f"{command}: exit {done.returncode}\n{done.stderr.decode()}"
    return done.stdout


def planned():
    return run("plan", stdin=run("ground", stdin=run("chunk", stdin=SENTENCE.encode())))


# 1. Every message decoded ---------------------------------------------------------------------------------------------

EXPECTED = {
    "/tf": "foxglove.FrameTransforms",
    "/tf_static": "foxglove.FrameTransforms",
    "/odom": "foxglove.PoseInFrame",
    "/sonar": "foxglove.PointCloud",
    "/camera/color/image_raw/compressed": "foxglove.CompressedImage",
    "/fetch/map": "foxglove.Grid",
    "/fetch/path": "foxglove.PosesInFrame",
    "/fetch/scene": "foxglove.SceneUpdate",
    "/fetch/scene_true": "foxglove.SceneUpdate",
    "/fetch/log": "foxglove.Log",
    "/fetch/velocity": "spatial_fetch.Velocity",
    "/fetch/input": "spatial_fetch.Record",
    "/fetch/chunk": "spatial_fetch.Record",
    "/fetch/ground": "spatial_fetch.Record",
    "/fetch/plan": "spatial_fetch.Record",
    "/fetch/drive": "spatial_fetch.Record",
}


def decode_all(path):
    """Counts by topic; every message decoded by its own schema, in order of time."""
    counts, schemas, last = collections.Counter(), {}, 0
    factory, decoders = DecoderFactory(), {}
    with open(path, "rb") as stream:
        for schema, channel, message in make_reader(stream, validate_crcs=True).iter_messages():
            if channel.message_encoding == "json":
                value = json.loads(message.data)
                json.loads(schema.data)
            else:
                if schema.id not in decoders:
                    decoders[schema.id] = factory.decoder_for(channel.message_encoding, schema)
                value = decoders[schema.id](message.data)
            assert value is not None
            assert message.log_time >= last, f"{channel.topic} goes back in time"
            last = message.log_time
            counts[channel.topic] += 1
            schemas[channel.topic] = schema.name
    return counts, schemas


def check_written(folder, extra=()):
    log = folder / "trial.mcap"
    plan = planned()
    out = run("drive", "--record", log, "--force", *extra, stdin=plan)
    counts, schemas = decode_all(log)
    for topic, schema in EXPECTED.items():
        assert schemas.get(topic) == schema, f"{topic}: {schemas.get(topic)}, not {schema}"
    with open(log, "rb") as stream:
        lines = [m.data for _, _, m in make_reader(stream).iter_messages(topics=["/fetch/drive"])]
    assert lines == [out.rstrip(b"\n")], "the record is not in the log byte for byte"
    assert run("drive", "--replay", log, *extra) == out, "the replay differs"
    print(f"  {' '.join(extra) or 'truth'}: {sum(counts.values())} messages on {len(counts)} topics decoded, the replay is the same")
    return log


# 2. Frames of another writer ------------------------------------------------------------------------------------------

WIDTH, HEIGHT, FOCAL = 320, 240, 262.5
BOXES = [((1.6, -0.5, 0.70), (2.4, 0.5, 0.74)), ((2.8, 0.6, 0.0), (3.3, 1.2, 0.45)), ((3.9, -2.0, 0.0), (4.0, 2.0, 2.5))]


def camera_pose(heading, tilt=math.radians(15), height=1.2):
    ahead = (math.cos(heading) * math.cos(tilt), math.sin(heading) * math.cos(tilt), -math.sin(tilt))
    right = (math.sin(heading), -math.cos(heading), 0.0)
    down = tuple(ahead[(i + 1) % 3] * right[(i + 2) % 3] - ahead[(i + 2) % 3] * right[(i + 1) % 3] for i in range(3))
    rows = [[right[i], down[i], ahead[i], (0.0, 0.0, height)[i]] for i in range(3)]
    return rows + [[0.0, 0.0, 0.0, 1.0]]


def cast(origin, direction):
    """Depth along the ray to the floor and the boxes, and which of them."""
    best, what = (-origin[2] / direction[2], 0) if direction[2] < 0 else (math.inf, 0)
    for number, (low, high) in enumerate(BOXES, 1):
        near, far = 0.0, math.inf
        for axis in range(3):
            d = direction[axis] or 1e-12
            a, b = (low[axis] - origin[axis]) / d, (high[axis] - origin[axis]) / d
            near, far = max(near, min(a, b)), min(far, max(a, b))
        if 0 < near < far and near < best:
            best, what = near, number
    return best, what


def frame(heading):
    pose = camera_pose(heading)
    origin = [pose[i][3] for i in range(3)]
    depth, color = [], bytearray()
    shades = [(120, 110, 100), (150, 90, 40), (60, 90, 160), (230, 230, 225)]
    for row in range(HEIGHT):
        for column in range(WIDTH):
            x, y = (column - (WIDTH - 1) / 2) / FOCAL, (row - (HEIGHT - 1) / 2) / FOCAL
            direction = [pose[i][0] * x + pose[i][1] * y + pose[i][2] for i in range(3)]
            metres, what = cast(origin, direction)
            depth.append(round(1000 * metres) if 0.5 < metres < 8 else 0)
            color += bytes(shades[what])
    return {"pose": pose, "depth": struct.pack(f"<{len(depth)}H", *depth), "color": bytes(color)}


def png(data, kind, bits, bytes_per_pixel):
    def chunk(name, body):
        return struct.pack(">I", len(body)) + name + body + struct.pack(">I", zlib.crc32(name + body))

    step = WIDTH * bytes_per_pixel
    rows = b"".join(b"\0" + data[at : at + step] for at in range(0, len(data), step))
    head = struct.pack(">IIBBBBB", WIDTH, HEIGHT, bits, kind, 0, 0, 0)
    return b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", head) + chunk(b"IDAT", zlib.compress(rows, 1)) + chunk(b"IEND", b"")


def big_endian(depth):
    return b"".join(depth[at + 1 : at + 2] + depth[at : at + 1] for at in range(0, len(depth), 2))


def write_lines(folder, frames):
    path = folder / "frames.jsonl"
    with open(path, "w") as lines:
        for i, f in enumerate(frames):
            (folder / f"{i}.depth.png").write_bytes(png(big_endian(f["depth"]), 0, 16, 2))
            (folder / f"{i}.png").write_bytes(png(f["color"], 2, 8, 3))
            record = {"depth": f"{i}.depth.png", "rgb": f"{i}.png", "fx": FOCAL, "fy": FOCAL, "cx": (WIDTH - 1) / 2,
                      "cy": (HEIGHT - 1) / 2, "depth_unit_m": 0.001, "T_world_cam": f["pose"]}
            lines.write(json.dumps(record) + "\n")
    return path


def quaternion(pose):
    """x, y, z, w of the rotation; good where w is not near zero, and made so by choosing the largest term."""
    m = [row[:3] for row in pose[:3]]
    trace = m[0][0] + m[1][1] + m[2][2]
    w = [1 + trace] + [1 + 2 * m[i][i] - trace for i in range(3)]
    k = w.index(max(w))
    s = 2 * math.sqrt(w[k])
    if k == 0:
        return ((m[2][1] - m[1][2]) / s, (m[0][2] - m[2][0]) / s, (m[1][0] - m[0][1]) / s, s / 4)
    i, j, n = k - 1, k % 3, (k + 1) % 3
    q = [0.0] * 4
    q[i], q[j], q[n], q[3] = s / 4, (m[j][i] + m[i][j]) / s, (m[n][i] + m[i][n]) / s, (m[n][j] - m[j][n]) / s
    return tuple(q)


LINE = "=" * 80 + "\n"
HEADER = LINE + "MSG: std_msgs/Header\nbuiltin_interfaces/Time stamp\nstring frame_id\n" + LINE + "MSG: builtin_interfaces/Time\nint32 sec\nuint32 nanosec\n"
IMAGE = "std_msgs/Header header\nuint32 height\nuint32 width\nstring encoding\nuint8 is_bigendian\nuint32 step\nuint8[] data\n" + HEADER
INFO = ("std_msgs/Header header\nuint32 height\nuint32 width\nstring distortion_model\nfloat64[] d\nfloat64[9] k\nfloat64[9] r\n"
        "float64[12] p\nuint32 binning_x\nuint32 binning_y\nsensor_msgs/RegionOfInterest roi\n" + HEADER + LINE +
        "MSG: sensor_msgs/RegionOfInterest\nuint32 x_offset\nuint32 y_offset\nuint32 height\nuint32 width\nbool do_rectify\n")
TF = ("geometry_msgs/TransformStamped[] transforms\n" + LINE + "MSG: geometry_msgs/TransformStamped\nstd_msgs/Header header\n"
      "string child_frame_id\ngeometry_msgs/Transform transform\n" + LINE + "MSG: geometry_msgs/Transform\ngeometry_msgs/Vector3 translation\n"
      "geometry_msgs/Quaternion rotation\n" + LINE + "MSG: geometry_msgs/Vector3\nfloat64 x\nfloat64 y\nfloat64 z\n" + LINE +
      "MSG: geometry_msgs/Quaternion\nfloat64 x\nfloat64 y\nfloat64 z\nfloat64 w\n" + HEADER)


def stamp(i):
    return 1_700_000_000_000_000_000 + i * 500_000_000


def ros2_log(path, frames):
    with open(path, "wb") as stream:
        writer = Ros2Writer(stream)
        image, info, tf = (writer.register_msgdef(name, text) for name, text in
                           [("sensor_msgs/msg/Image", IMAGE), ("sensor_msgs/msg/CameraInfo", INFO), ("tf2_msgs/msg/TFMessage", TF)])
        for i, f in enumerate(frames):
            head = {"stamp": {"sec": stamp(i) // 10**9, "nanosec": stamp(i) % 10**9}, "frame_id": "camera_color_optical_frame"}
            k = [FOCAL, 0.0, (WIDTH - 1) / 2, 0.0, FOCAL, (HEIGHT - 1) / 2, 0.0, 0.0, 1.0]
            (x, y, z), (qx, qy, qz, qw) = [row[3] for row in f["pose"][:3]], quaternion(f["pose"])
            place = {"translation": {"x": x, "y": y, "z": z}, "rotation": {"x": qx, "y": qy, "z": qz, "w": qw}}
            writer.write_message("/tf", tf, {"transforms": [{"header": dict(head, frame_id="map"),
                                 "child_frame_id": head["frame_id"], "transform": place}]}, stamp(i))
            writer.write_message("/camera/color/camera_info", info, {
                "header": head, "height": HEIGHT, "width": WIDTH, "distortion_model": "plumb_bob", "d": [0.0] * 5, "k": k,
                "r": [1.0, 0, 0, 0, 1.0, 0, 0, 0, 1.0], "p": [0.0] * 12, "binning_x": 0, "binning_y": 0,
                "roi": {"x_offset": 0, "y_offset": 0, "height": 0, "width": 0, "do_rectify": False}}, stamp(i))
            for topic, encoding, data in [("/camera/color/image_raw", "rgb8", f["color"]), ("/camera/depth/image_raw", "16UC1", f["depth"])]:
                writer.write_message(topic, image, {"header": head, "height": HEIGHT, "width": WIDTH, "encoding": encoding,
                                     "is_bigendian": 0, "step": len(data) // HEIGHT, "data": data}, stamp(i))
        writer.finish()


def ros1_log(path, frames):
    def text(value):
        return struct.pack("<I", len(value)) + value.encode()

    with open(path, "wb") as stream:
        writer = Writer(stream)
        writer.start(profile="ros1")
        channels = {}
        for topic, name in [("/tf", "tf2_msgs/TFMessage"), ("/info", "sensor_msgs/CameraInfo"), ("/rgb", "sensor_msgs/Image"), ("/depth", "sensor_msgs/Image")]:
            schema = writer.register_schema(name, "ros1msg", b"# left out")
            channels[topic] = writer.register_channel(topic, "ros1", schema)
        for i, f in enumerate(frames):
            def head(frame_id):
                return struct.pack("<III", i, stamp(i) // 10**9, stamp(i) % 10**9) + text(frame_id)

            k = [FOCAL, 0.0, (WIDTH - 1) / 2, 0.0, FOCAL, (HEIGHT - 1) / 2, 0.0, 0.0, 1.0]
            messages = {
                "/tf": struct.pack("<I", 1) + head("map") + text("kinect") + struct.pack("<7d", *[row[3] for row in f["pose"][:3]], *quaternion(f["pose"])),
                "/info": head("kinect") + struct.pack("<II", HEIGHT, WIDTH) + text("plumb_bob") + struct.pack("<I", 0) + struct.pack("<9d", *k) + bytes(8 * 21 + 25),
            }
            for topic, encoding, data in [("/rgb", "rgb8", f["color"]), ("/depth", "16UC1", f["depth"])]:
                messages[topic] = head("kinect") + struct.pack("<II", HEIGHT, WIDTH) + text(encoding) + struct.pack("<BII", 0, len(data) // HEIGHT, len(data)) + data
            for topic, data in messages.items():
                writer.add_message(channels[topic], stamp(i), data, stamp(i))
        writer.finish()


def check_frames(folder):
    frames = [frame(heading) for heading in (0.0, 0.3, -0.2)]
    expected = [json.loads(line)["detections"] for line in run("perceive", write_lines(folder, frames)).splitlines()]
    assert any(expected), "nothing was detected, so nothing is compared"
    for name, write in [("ROS 2 by mcap-ros2-support", ros2_log), ("ROS 1 by mcap", ros1_log)]:
        path = folder / "frames.mcap"
        write(path, frames)
        got = [json.loads(line)["detections"] for line in run("perceive", "--from", path).splitlines()]
        assert got == expected, f"{name}: other detections than from the JSON lines"
        piped = [json.loads(line)["detections"] for line in run("perceive", stdin=path.read_bytes()).splitlines()]
        assert piped == expected, f"{name}: other detections through a pipe"
        print(f"  {name}: {len(frames)} frames, {sum(map(len, expected))} detections, equal to those of the JSON lines")


# 3. Killed ------------------------------------------------------------------------------------------------------------


def times(path):
    """Log times of the odometry, by the independent reader, as far as the log goes."""
    seen, odometry = [], None
    try:
        with open(path, "rb") as stream:
            for record in StreamReader(stream).records:
                if isinstance(record, Channel) and record.topic == "/odom":
                    odometry = record.id
                elif isinstance(record, Message) and record.channel_id == odometry:
                    seen.append(record.log_time / 1e9)
    except Exception:  # noqa: BLE001 – a cut log ends in one error or another
        pass
    return seen


def check_killed(folder):
    plan = folder / "plan.jsonl"
    plan.write_bytes(planned())
    whole, log = folder / "whole.mcap", folder / "killed.mcap"
    run("drive", "--record", whole, plan)
    everything, flushed, draw = times(whole), flushes(whole), random.Random(1)
    moving = [place for place, time in flushed if time > 0]
    short = []
    for i in range(10):
        log.unlink(missing_ok=True)
        process = subprocess.Popen([BIN / "drive", "--record", log, plan], stdout=subprocess.PIPE, stderr=subprocess.DEVNULL)
        # A trial is over in a blink: the moment is chosen by how far its log has grown.
        grown = moving[int(len(moving) * (i + draw.random()) / 10)]
        while process.poll() is None and not (log.exists() and log.stat().st_size >= grown):
            pass
        process.send_signal(signal.SIGKILL)
        process.wait()
        seen = times(log)
        assert seen == everything[: len(seen)], "the log has a gap"
        assert seen, "nothing of the trial is left"
        out = subprocess.run([BIN / "plan", "--from", log, "--recover"], capture_output=True)
        # 3, but for a trial that had ended before the signal came.
        assert out.returncode == (0 if log.read_bytes() == whole.read_bytes() else 3), out.stderr
        assert json.loads(out.stdout)["id"] == "1", "the record is not recovered"
        short.append(f"{seen[-1]:.1f} s")
    gaps = [b - a for (_, a), (_, b) in zip(flushed, flushed[1:])]
    assert max(gaps) <= 1.0 + 1e-6, f"{max(gaps)} s between two flushes"
    print(f"  killed at ten moments, the log reached: {', '.join(short)} of {everything[-1]:.1f} s; at most {max(gaps):.1f} s between flushes")


def flushes(path):
    """The end of each chunk, bytes and seconds: what had been handed to the disk by then."""
    with open(path, "rb") as stream:
        records = StreamReader(stream, emit_chunks=True).records
        return [(stream.tell(), record.message_end_time / 1e9) for record in records if isinstance(record, Chunk)]


def main():
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        print("every message decoded by mcap and mcap-protobuf-support:")
        check_written(folder)
        print("frames of other writers:")
        check_frames(folder)
        print("killed while recording:")
        check_killed(folder)


main()
