#!/usr/bin/env python3
"""A ROS 1 base with kinematics of its own, for `.ci/ros_check.sh`: exact arcs, a scanner in a rectangular room.

ros_base.py ROOM_JSON TRUTH_FILE [FAULT]: FAULT is nan, silent, clock or length, and begins after 4 s of motion.
It stops by itself after 0.5 s without a command, and writes what it hears and does, one JSON line a tenth of a second.
"""
import json
import math
import sys

import rospy
from geometry_msgs.msg import TransformStamped, Twist
from nav_msgs.msg import Odometry
from sensor_msgs.msg import LaserScan
from tf2_msgs.msg import TFMessage

TIMEOUT_S = 0.5
BEAMS = 180


class Junk(LaserScan):
    """A scan of the wrong endianness: its lengths are not those of what follows."""

    def serialize(self, buff):
        buff.write(b"\x00\x00\x00\x01" * 20)


class Base:
    def __init__(self, room, truth, fault):
        self.room, self.truth, self.fault = room, truth, fault
        self.x, self.y, self.heading = room["start"]
        self.v = self.w = 0.0
        self.asked, self.asked_at, self.zeros, self.commands = (0.0, 0.0), 0.0, 0, 0
        self.by_timeout = 0
        self.moved_s = 0.0
        self.distance = 0.0
        rospy.Subscriber("/cmd_vel", Twist, self.command, tcp_nodelay=True)
        self.odom = rospy.Publisher("/odom", Odometry, queue_size=1)
        self.scan = rospy.Publisher("/scan", LaserScan, queue_size=1)
        self.tf = rospy.Publisher("/tf", TFMessage, queue_size=5)

    def command(self, twist):
        self.commands += 1
        self.asked, self.asked_at = (twist.linear.x, twist.angular.z), rospy.get_time()
        if self.asked == (0.0, 0.0):
            self.zeros += 1

    def is_faulty(self):
        return self.fault and self.moved_s > 4.0

    def step(self, dt):
        asked = self.asked
        if rospy.get_time() - self.asked_at > TIMEOUT_S and asked != (0.0, 0.0):
            self.by_timeout += 1
            self.asked = asked = (0.0, 0.0)
        slew = lambda now, goal, most: now + max(-most, min(most, goal - now))
        self.v = slew(self.v, asked[0], 0.6 * dt)
        self.w = slew(self.w, asked[1], 2.0 * dt)
        if abs(self.v) > 0.05:
            self.moved_s += dt
        turn = self.w * dt
        # The chord of the arc, exactly.
        chord = self.v * dt if abs(turn) < 1e-9 else 2 * self.v / self.w * math.sin(turn / 2)
        self.x += chord * math.cos(self.heading + turn / 2)
        self.y += chord * math.sin(self.heading + turn / 2)
        self.heading += turn
        self.distance += abs(self.v) * dt

    def stamp(self):
        jump = 3600.0 if self.fault == "clock" and self.is_faulty() else 0.0
        return rospy.Time.from_sec(rospy.get_time() - jump)

    def say(self, tick):
        if self.fault == "silent" and self.is_faulty():
            return
        odometry = Odometry()
        odometry.header.stamp, odometry.header.frame_id = self.stamp(), "odom"
        odometry.child_frame_id = "base_footprint"
        odometry.pose.pose.position.x, odometry.pose.pose.position.y = self.x, self.y
        odometry.pose.pose.orientation.z = math.sin(self.heading / 2)
        odometry.pose.pose.orientation.w = math.cos(self.heading / 2)
        odometry.twist.twist.linear.x, odometry.twist.twist.angular.z = self.v, self.w
        self.odom.publish(odometry)
        place = TransformStamped()
        place.header, place.child_frame_id = odometry.header, "base_footprint"
        place.transform.translation.x, place.transform.translation.y = self.x, self.y
        place.transform.rotation = odometry.pose.pose.orientation
        laser = TransformStamped()
        laser.header.stamp, laser.header.frame_id = odometry.header.stamp, "base_footprint"
        laser.child_frame_id = "base_scan"
        laser.transform.translation.x, laser.transform.translation.z = 0.08, 0.2
        laser.transform.rotation.w = 1.0
        self.tf.publish(TFMessage([place, laser]))
        if tick % 4 == 0:
            self.scan.publish(self.measured(odometry.header.stamp))

    def measured(self, stamp):
        junk = self.fault == "length" and self.is_faulty()
        scan = Junk() if junk else LaserScan()
        scan.header.stamp, scan.header.frame_id = stamp, "base_scan"
        scan.angle_min, scan.angle_increment = -math.pi, 2 * math.pi / BEAMS
        scan.angle_max = scan.angle_min + scan.angle_increment * (BEAMS - 1)
        scan.range_min, scan.range_max = 0.05, 12.0
        ox = self.x + 0.08 * math.cos(self.heading)
        oy = self.y + 0.08 * math.sin(self.heading)
        bad = self.fault == "nan" and self.is_faulty()
        for i in range(BEAMS):
            angle = self.heading + scan.angle_min + scan.angle_increment * i
            scan.ranges.append(float("nan") if bad else self.beam(ox, oy, angle))
        return scan

    def beam(self, ox, oy, angle):
        cos, sin = math.cos(angle), math.sin(angle)
        best = float("inf")
        for (ax, ay), (bx, by) in self.room["walls"]:
            ex, ey = bx - ax, by - ay
            across = cos * ey - sin * ex
            if abs(across) < 1e-12:
                continue
            way = ((ax - ox) * ey - (ay - oy) * ex) / across
            share = ((ax - ox) * sin - (ay - oy) * cos) / across
            if way > 0 and 0 <= share <= 1:
                best = min(best, way)
        return best


def main():
    rospy.init_node("other_base", disable_signals=False)
    room = json.load(open(sys.argv[1]))
    base = Base(room, open(sys.argv[2], "w", buffering=1), sys.argv[3] if len(sys.argv) > 3 else "")
    rate, tick, dt = rospy.Rate(40), 0, 1 / 40
    while not rospy.is_shutdown():
        base.step(dt)
        base.say(tick)
        if tick % 4 == 0:
            told = dict(t=rospy.get_time(), x=base.x, y=base.y, heading=base.heading, v=base.v, w=base.w)
            told.update(zeros=base.zeros, commands=base.commands, by_timeout=base.by_timeout)
            base.truth.write(json.dumps(dict(told, distance=base.distance, faulty=bool(base.is_faulty()))) + "\n")
        tick += 1
        rate.sleep()


if __name__ == "__main__":
    try:
        main()
    except rospy.ROSInterruptException:
        pass
