# SPDX-License-Identifier: MIT
"""The promise: what goes in by the package's names goes to the library as it is, and what comes out is the library's. Crowds of the corpus
are played frame by frame; their digests, poses and answers are those of C++.
  SCENES: what tools/digest/print_scenes.cpp wrote."""
import functools
import json
import os
import re
import unittest
from pathlib import Path

import numpy as np

import swivel
from swivel import (BodyGroup, EulerOrder, Feature, Field, Ground, Group, LookGroup, OnBadInput, Plant, Pose, PoseSpace, PropGroup, Region, ShiftGroup,
                    Support)

COMPONENTS = {"rotations": 4, "translations": 3, "scales": 3, "results": 4, "translation_results": 3, "joint_rotations": 4, "joint_positions": 3}
OUTPUTS = {"results": "out", "translation_results": "out_translations"}  # as a Pose names them
SHAPES = [(4,), (3, 4), (4, 4), (4, 3)]  # of a joint by the pose's form; columns are turned below
CARRIED = [Field.NORMAL, Field.PLANT, Field.PLANT_ROTATION, Field.CONTACT_STATE, Field.SHIFT, Field.LIFT, Field.LOOK_TURNS]
STRUCTURES = ("plant", "ground", "shift", "prop", "look", "joints")  # of a group
ENUMS = {"on_bad_input": OnBadInput, "shoulder_order": EulerOrder, "wrist_order": EulerOrder}


@functools.lru_cache(maxsize=None)
def scenes():
    return json.loads(Path(os.environ["SCENES"]).read_text(encoding="utf-8"))


def array(values, dtype=np.float32):
    return np.array(values, float).astype(dtype)  # null is NaN


def region_of(given):
    region = Region()
    region.add_cones(given["axes"], given["angles"], closed=True)
    region.add_polygon(array(given["corners"]).reshape(-1, 3))
    region.add_directions(array(given["directions"]).reshape(-1, 3), given["margin"], given["max_cones"])
    region.forbid(**given["forbidden"])
    return region.mirrored()


def group_of(given):
    for kind, name in ((ShiftGroup, "shift"), (PropGroup, "prop"), (LookGroup, "look")):
        if name in given:
            return kind(**given[name])
    options = dict(given, **{name: enum(given[name]) for name, enum in ENUMS.items() if name in given})
    options["features"] = functools.reduce(lambda all, name: all | Feature[name], given["features"], Feature(0))
    for name, kind in (("plant", Plant), ("ground", Ground)):
        if name in options:
            options[name] = kind(**options[name])
    if "region" in options:
        options["region"] = region_of(given["region"])
    if "joints" in options:
        return BodyGroup(**options.pop("joints"), **options)
    return Group(**options)


class Player:
    def __init__(self, scene):
        self.scene, groups = scene, [group_of(group) for group in scene["groups"]]
        self.bodies = scene.get("body_count", 0)
        if not self.bodies:
            self.crowd = swivel.Crowd(groups)
            return
        skeleton, self.joints = scene["skeleton"], len(scene["skeleton"]["parents"])
        skeleton = {name: values if name == "parents" else array(values).reshape(self.joints, -1) for name, values in skeleton.items()}
        options = {"up": scene["up"]} if "up" in scene else {}
        self.crowd = swivel.Crowd(groups, skeleton=swivel.Skeleton(**skeleton), body_count=self.bodies, **options)

    def write(self, frame):
        for change in frame.get("carried", ()):
            place = dict(group=change["group"], first=change["body"], count=1)
            if "was" in change:
                self.crowd.change_support(Support(**change["was"]), Support(**change["now"]), **place)
            else:
                self.crowd.reset(**place)
        for group, inputs in enumerate(frame["inputs"]):
            for name, values in inputs.items():
                shape = (self.crowd.limb_count(group), -1) if self.crowd.component_count(Field[name.upper()], group) > 1 else -1
                self.crowd.write(Field[name.upper()], array(values).reshape(shape), group)

    def pose(self, frame):
        """The Pose, and the arrays that a solve writes, as they lie in memory."""
        scene, form = self.scene, self.scene["form"]
        of_joints = lambda name: (self.bodies, self.joints, *(SHAPES[form] if name in ("rotations", "results") else (COMPONENTS[name],)))
        kinds = {name: float if scene["root_is_double"] and name in ("root_position", "support_position") else np.float32 for name in frame["pose"]}
        arrays = {name: array(values, kinds[name]) for name, values in frame["pose"].items()}
        for name in arrays:
            arrays[name] = arrays[name].reshape(of_joints(name) if name in COMPONENTS else (self.bodies, -1) if arrays[name].size > self.bodies else -1)
        arrays.update({name: np.zeros(of_joints(name), np.float32) for name in scene["outputs"]})
        turned = {name: np.swapaxes(values, 2, 3) if form >= 2 and name in ("rotations", "results") else values for name, values in arrays.items()}
        given = {OUTPUTS.get(name, "matrices" if form and name == "rotations" else name): values for name, values in turned.items()}
        moved = ("translation_results", "translations") if scene["space"] else ()
        chosen = [next((name for name in names if name in arrays), None) for names in (("results", "rotations"), moved)]
        order = [name for name in (*chosen, "joint_rotations", "joint_positions") if name in arrays]
        return Pose(space=PoseSpace(scene["space"]), **given), [arrays[name] for name in order]

    def solve(self, frame):
        """How many were solved, the crowd's digest, and that of the poses."""
        self.write(frame)
        if not self.bodies:
            return self.crowd.solve(), f"{self.crowd.digest():x}", f"{0x811c9dc5:x}"
        pose, written = self.pose(frame)
        job = {"pose": pose}
        if "doubles" in frame:
            job["streams"] = [{name: array(values, float).reshape(self.bodies, 3) for name, values in fields.items()} for fields in frame["doubles"]]
        if "mask" in frame:
            job["mask"] = (frame["mask"] >> np.arange(self.crowd.lane_count) & 1).astype(bool)
        return self.crowd.solve(**job), f"{self.crowd.digest():x}", f"{digest(written):x}"

    def play(self):
        return (self.solve(frame) for frame in self.scene["frames"])

    def last(self):
        return [*self.play()][-1]

    def answers(self, group):
        crowd, given = self.crowd, self.scene["groups"][group]
        orders = EulerOrder(given["wrist_order"]), EulerOrder(given["shoulder_order"])
        found = {name: getattr(crowd, name)(group=group) for name in ("elbows", "wrists", "hands", "residuals") if name in self.scene["answers"][group]}
        return {**found, "joint_angles": crowd.joint_angles(*orders, family=1, group=group), "allowed_arcs": crowd.allowed_arcs(0, group=group)}


def digest(arrays):
    """FNV-1a of words, in which all NaN are one."""
    hash = 0x811C9DC5
    for values in arrays:
        words = np.where(np.isnan(values), np.uint32(0x7FC00000), np.ascontiguousarray(values).view(np.uint32))
        for word in words.ravel().tolist():
            hash = (hash ^ word) * 0x01000193 & 0xFFFFFFFF
    return hash


def keys(value, path=()):
    """Where the objects of a scene have members, from the scene on."""
    if isinstance(value, dict):
        for name, member in value.items():
            yield (*path, name)
            yield from keys(member, (*path, name))
    elif isinstance(value, list) and value and isinstance(value[0], dict):
        for each in value:
            yield from keys(each, path)


def edited(value, path, edit):
    """With edit(object) in the place of each object that has the member there."""
    if isinstance(value, list):
        return [edited(each, path, edit) for each in value] if value and isinstance(value[0], dict) else value
    if path[0] not in value:
        return value
    return edit(value) if len(path) == 1 else {**value, path[0]: edited(value[path[0]], path[1:], edit)}


def without(value, path):
    return edited(value, path, lambda of: {name: member for name, member in of.items() if name != path[-1]})


def scenes_by_member():
    of = {}
    for scene in scenes():
        for path in set(keys(scene)):
            of.setdefault(path, []).append(scene)
    return of


class Scenes(unittest.TestCase):
    def test_frames_have_the_digests_of_cpp(self):
        for scene in scenes():
            player = Player(scene)
            for number, frame in enumerate(scene["frames"]):
                with self.subTest(scene["name"], frame=number):
                    self.assertEqual(player.solve(frame), (frame["solved"], frame["digest"], frame["poses"]))
            for group, answers in enumerate(scene["answers"]):
                found = player.answers(group)
                with self.subTest(scene["name"], group=group):
                    self.assertEqual(player.crowd.explain(limb=0, group=group).replace("Feature.", "SWIVEL_"), answers["explain"])
                    self.assertEqual({*found, "explain"}, set(answers))
                    for name, values in found.items():
                        np.testing.assert_array_equal(values.ravel(), array(answers[name], values.dtype), name)

    def test_what_is_carried_can_be_set_back(self):
        """Crowds of C go on from there as they were (tests/library/test_bits.cpp)."""
        seen = set()
        for scene in (scene for scene in scenes() if scene["name"].startswith("standing")):
            player, other = Player(scene), Player(scene).crowd
            player.last()
            for group in range(other.group_count):
                for field in (field for field in CARRIED if other.component_count(field, group)):
                    saved = player.crowd.read(field, group)
                    other.write(field, saved, group)
                    np.testing.assert_array_equal(other.read(field, group), saved)
                    seen |= {field} if np.any(saved) else set()
        self.assertEqual(seen, set(CARRIED))

    def test_regions_have_the_room_of_cpp(self):
        given = next(group["region"] for scene in scenes() for group in scene["groups"] if "region" in group)
        np.testing.assert_array_equal(region_of(given).room(array(given["probes"]).reshape(-1, 3)), array(given["rooms"]))

    def test_every_argument_counts(self):
        """Whatever is left out, some scene goes another way, or is refused."""
        of = scenes_by_member()
        given = [path for path in of if path[0] in ("groups", "skeleton", "up") or path[:2] in (("frames", "inputs"), ("frames", "pose"), ("frames", "doubles"), ("frames", "carried"))]
        given = [path for path in given if path[-1] not in ("probes", "rooms")]
        self.assertGreater(len(given), 100)

        def counts(scene, path):
            try:
                return any(found != (frame["solved"], frame["digest"], frame["poses"])
                           for found, frame in zip(Player(without(scene, path)).play(), scene["frames"]))
            except (KeyError, TypeError, ValueError):
                return True
        self.assertEqual([path for path in given if not any(counts(scene, path) for scene in of[path])], [])

    def test_every_member_of_what_bodies_are_made_of_refuses_what_it_is_not(self):
        """A text, or numbers of another count, is refused in one line that names the member."""
        of, count = scenes_by_member(), 0
        for path in of:
            of_structure = len(path) == 3 and path[0] == "groups" and path[1] in STRUCTURES
            if of_structure or path in (("groups", "link"), ("up",)) or (path[:2] == ("frames", "carried") and len(path) == 4):
                name = path[-1] if "joints" in path[:-1] else ".".join(path[-2:] if len(path) > 2 else path[-1:])
                for wrong in ("x", [0.5] * 14):
                    with self.subTest(path, wrong=wrong), self.assertRaisesRegex((TypeError, ValueError), re.escape(name)) as caught:
                        Player(edited(of[path][0], path, lambda of: {**of, path[-1]: wrong})).last()
                    self.assertNotIn("\n", str(caught.exception))
                count += 1
        self.assertGreaterEqual(count, 40)

    def test_every_feature_input_and_part_of_a_pose_is_in_some_scene(self):
        players = [Player(scene) for scene in scenes()]
        crowds = [(player.crowd, group) for player in players for group in range(player.crowd.group_count)]
        features = functools.reduce(lambda all, each: all | each[0].features(each[1]), crowds, Feature(0))
        self.assertEqual([each.name for each in Feature if not features & each], ["JOINTS"])  # bindings' own: test_numbers
        inputs = {name for scene in scenes() for frame in scene["frames"] for fields in (*frame["inputs"], *frame.get("doubles", ())) for name in fields}
        self.assertEqual({field.name.lower() for field in Field if field < Field.SHOULDER}, inputs)
        given = {name for scene in scenes() for frame in scene["frames"] for name in (*frame.get("pose", ()), *scene.get("outputs", ()))}
        self.assertEqual({OUTPUTS.get(name, name) for name in given} | {"matrices", "space"}, set(Pose._fields))


if __name__ == "__main__":
    unittest.main()
