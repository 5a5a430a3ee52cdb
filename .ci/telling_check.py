#!/usr/bin/env python3
"""What the robot says of where a thing was leads back to it: the loop of both directions of language, in homes made at
random. .ci/telling_check.py [HOMES]: in each home one object is fetched, and the sentence that the trial says of its
place (`trial.description`) goes through `chunk | ground | plan | drive` in the same home. It must lead to the same
furniture first in 95 of 100 homes. Needs the executables on the PATH."""

import json
import os
import random
import subprocess
import sys
import tempfile

LEAST = 0.95


def output(command, said=None):
    return subprocess.run(command, input=said, capture_output=True, text=True, check=False).stdout


class Home:
    """A home made at random, as files."""

    def __init__(self, folder, seed):
        self.seed = seed
        self.scene = os.path.join(folder, f"{seed}.scene.json")
        self.map = os.path.join(folder, f"{seed}.map.json")
        scene = output(["evaluate", "scene", "--new", "--seed", str(seed)])
        with open(self.scene, "w") as file:
            file.write(scene)
        with open(self.map, "w") as file:
            json.dump(json.loads(scene)["map"], file)

    def object(self):
        """One that has no namesake."""
        objects = json.loads(output(["drive", "--world", self.scene, "--list", "--format", "json"]))["objects"]
        names = [thing["name"] for thing in objects]
        alone = [thing for thing in objects if names.count(thing["name"]) == 1]
        return random.Random(self.seed).choice(alone) if alone else None

    def trial(self, text):
        record = json.dumps({"id": str(self.seed), "text": text}) + "\n"
        plan = ["plan", "--map", self.map]
        for stage in (["chunk"], ["ground"], plan, ["drive", "--world", self.scene]):
            record = output(stage, record)
        return json.loads(record)["trial"] if record.strip() else {}


def leads_back(home):
    """None where there is nothing to tell: no object without a namesake, or it was not found the first time."""
    thing = home.object()
    if thing is None:
        return None
    name, room = (thing[key].replace("_", " ") for key in ("name", "room"))
    told = home.trial(f"find the {name} in the {room}").get("description")
    if not told:
        return None
    went_to = (home.trial(told).get("approached") or [None])[0]
    if went_to != thing["on"]:
        print(f"home {home.seed}: it stood on {thing['on']}, said was: {told} and gone to was {went_to}")
    return went_to == thing["on"]


def interval(hits, count):
    """Wilson's, of 95 %."""
    z = 1.96
    middle = (hits + z * z / 2) / (count + z * z)
    half = z * ((hits * (count - hits) / count + z * z / 4) ** 0.5) / (count + z * z)
    return f"{100 * (middle - half):.1f} to {100 * (middle + half):.1f} %"


def main():
    homes = int(sys.argv[1]) if len(sys.argv) > 1 else 40
    with tempfile.TemporaryDirectory() as folder:
        results = [leads_back(Home(folder, seed)) for seed in range(homes)]
    told = [result for result in results if result is not None]
    hits = sum(told)
    print(f"what was told led to the same furniture first in {hits} of {len(told)} homes"
          f" ({100 * hits / len(told):.1f} %, {interval(hits, len(told))}); {homes - len(told)} homes told nothing")
    sys.exit(hits < LEAST * len(told) - 1)


if __name__ == "__main__":
    main()
