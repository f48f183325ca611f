# SPDX-License-Identifier: MIT
"""The promise: every argument of every call counts, and crowds and regions that cannot be are refused in one line. Constructors' arguments count
in test_scenes, which has wrong ones of each; shapes and types of arrays are in test_arrays and test_bodies."""
import ast
import unittest
from pathlib import Path

import numpy as np

import swivel
from figures import Refusals, Sample, limb_of, quaternions
from swivel import (BodyGroup, EulerOrder, Feature, Field, Group, Kind, LookGroup, Pose, PropGroup, Region, ShiftGroup, Skeleton, Support)

STUB = ast.parse((Path(swivel.__file__).parent / "_core.pyi").read_text(encoding="utf-8"))
CONE = [(0, 0, 1), (1, 0, 0.5)]
TREE = {"parents": [-1, 0, 1, 2, 3, 2], "translations": [(0, 0, 0), (0.1, 0, 0), (0.3, 0, 0), (0.1, 0, 0), (0.15, 0, 0), (0.1, 0, 0)], "shoulder": 1, "elbow": 2,
        "wrist": 4, "bend": (0, 0, 1)}
TURNS = [(0, 0, 0, 1), (0.1, 0, 0, 1), (0, 0.2, 0, 1), (0, 0, 0.3, 1), (0.1, 0.2, 0, 1), (0, 0, 0.1, 1)]


def cones(**given):
    region = Region()
    region.add_cones(given.pop("axes"), given.pop("angles"), **given)
    return region


class Limbs:
    """A solved crowd of two groups: 5 plain limbs, and 6 with hands. It answers as its crowd does."""

    def __init__(self):
        features = Feature.WITH_ANGLE | Feature.WITH_SHOULDER_CONE | Feature.WITH_HUMERAL_TWIST
        self.crowd = swivel.Crowd([Group(5, features=features), Group(6, features=features | Feature.WITH_HAND | Feature.WITH_MAX_SWIVEL)])
        for group, count in enumerate((5, 6)):
            sample = Sample(count, seed=group)
            for field, values in ((Field.TARGET, sample.targets), (Field.POLE, sample.poles), (Field.LENGTHS, sample.lengths)):
                self.crowd.write(field, values, group)
            cone = [swivel.cone((1, n, 0.5), 1 + 0.2 * n) for n in range(count)]
            self.crowd.write(Field.SHOULDER_CONE, cone, group)
        self.crowd.write(Field.HAND, quaternions(np.random.default_rng(1), 6), 1)
        self.crowd.write(Field.MAX_SWIVEL, swivel.cos_sin(0.1), 1)
        self.crowd.write(Field.TARGET, (9, 9, 9), 1, 3, 1)
        self.crowd.solve()

    def after(self, name, **given):
        """What a call that changes the crowd leaves."""
        getattr(self.crowd, name)(**given)
        return [self.crowd.read(field, group) for field in (Field.TARGET, Field.POLE, Field.ANGLE, Field.NORMAL) for group in (0, 1) if self.crowd.component_count(field, group)]

    def __getattr__(self, name):
        return getattr(self.crowd, name)


PLACE, SOME = {"group": 1}, {"group": 1, "first": 2, "count": 2}
OTHERS = {"group": 0, "first": 1, "count": 1}
# Of each call: arguments, and others, each of which alone must change what it answers or what it leaves.
FUNCTIONS = {
    "range": ({"min": 0, "max": 1}, {"min": 0.1, "max": 1.1}),
    "cone": ({"axis": (0, 0, 1), "max": 1}, {"axis": (0, 1, 1), "max": 0.5}),
    "flexion": ({"min": 0, "max": 2}, {"min": 0.1, "max": 1.5}),
    "cos_sin": ({"angle": 1}, {"angle": 2}),
    "aim": ({"axis": (0, 0, 1), "flexion": 1}, {"axis": (0, 1, 0), "flexion": 2}),
    "mirror": ({"field": Field.SHOULDER_BOX, "values": np.concatenate([swivel.range(-0.2, 0.3 + n) for n in (0.0, 0.1, 0.2)])},
               {"field": Field.SHOULDER_CONE, "values": np.concatenate([swivel.range(-0.1, 0.3)] * 3), "order": EulerOrder.ZXY}),
    "arm_axis": ({"binding": limb_of((0.3, 0, 0), (0.25, 0, 0)), "parent_rotation": (0, 0, 0, 1), "direction": (0, 1, 0)},
                 {"binding": limb_of((0, 0.3, 0), (0, 0.2, 0)), "parent_rotation": (0.5, 0, 0, 1), "direction": (0, 0, 1)}),
    "needed_features": ({"field": Field.HAND}, {"field": Field.AIM}),
    "field_kinds": ({"field": Field.HAND}, {"field": Field.LOOK_TARGET}),
    "bind_joints": (TREE, {"parents": [-1, 0, 1, 2, 2, 2], "translations": [*TREE["translations"][:4], (0.2, 0.1, 0), (0.1, 0, 0)], "shoulder": 0, "elbow": 3, "wrist": 3,
                           "rotations": TURNS, "twist_bones": [5], "bend": (0, 1, 1)}),
    "steps": ({"target": (1, 1, 1), "pole": (1, 1, 0), "upper": 1.4, "fore": 1.3}, {"target": (1, 1, 0.5), "pole": (0, 1, 0), "upper": 1.5, "fore": 1.2}),
    "blade_name": ({"blade": 1}, {"blade": 2}),
    "verify": ({"arm_count": 50, "seed": 1}, {"arm_count": 60, "seed": 2}),
    "unpack_rotations": ({"words": np.uint16((1, 2, 3))}, {"words": np.uint16((30000, 2, 3))}),
}
METHODS = {
    "features": ({}, PLACE), "limb_count": ({}, PLACE), "limbs": ({}, PLACE), "pack": ({}, PLACE),
    "component_count": ({"field": Field.HAND, "group": 1}, {"field": Field.POLE, "group": 0}),
    "rows": ({"field": Field.TARGET}, {"field": Field.POLE, **PLACE}),
    "packed_row": ({"field": Field.FLAGS}, {"field": Field.ELBOW, **PLACE}),
    "read": ({"field": Field.TARGET, **SOME}, {"field": Field.POLE, **OTHERS}),
    **{name: (SOME, OTHERS) for name in ("elbows", "wrists", "residuals")}, "hands": (SOME, {"first": 1, "count": 1}),
    "joint_angles": (SOME, {"shoulder_order": EulerOrder.ZYX, "wrist_order": EulerOrder.ZYX, "family": 1, **OTHERS}),
    "explain": ({"limb": 3, "group": 1}, {"limb": 1, "group": 0}),
    "allowed_arcs": ({"limb": 3, "group": 1}, {"limb": 5, "group": 0}),
    "write": ({"field": Field.TARGET, "values": (1, 2, 3), **SOME}, {"field": Field.POLE, "values": (1, 2, 4), **OTHERS}),
    "write_doubles": ({"field": Field.TARGET, "values": (1e9, 2, 3), "origins": (1e9, 0, 0), **SOME},
                      {"field": Field.POLE, "values": (1e9, 2, 4), "origins": (1e9, 1, 0), **OTHERS}),
    "reset": (SOME, OTHERS),
}
# These are in test_numbers and test_scenes, below, test_bodies, test_numbers again, and, what comes out, in test_arrays. The last are in test_bodies.
ELSEWHERE = {"solve", "change_support", "kind", "compare", "choose", "digest", "version", "isa_name", "isas", "use_isa", "fill_cache",
             "save", "load", "reset_bodies", "state_digest", "draw"}


def same_of(answer):
    """Something that compares, of any answer."""
    if isinstance(answer, np.ndarray):
        return answer.shape, answer.tobytes()
    return [same_of(each) for each in answer] if isinstance(answer, (list, tuple)) else repr(answer)


class Counts(unittest.TestCase):
    def check(self, call, usual, others):
        answers = [same_of(call(**usual))] + [same_of(call(**{**usual, name: other})) for name, other in others.items()]
        for name, answer in zip(others, answers[1:]):
            self.assertNotEqual(answer, answers[0], name)
        self.assertEqual(same_of(call(**usual)), answers[0])

    def test_every_argument_of_functions_and_methods(self):
        [crowd] = [each for each in STUB.body if isinstance(each, ast.ClassDef) and each.name == "Crowd"]
        mirrored = lambda field, values, order=0: swivel.mirror(field, values[:12 if field == Field.SHOULDER_BOX else 4], order)
        made = lambda name: {"verify": lambda **given: swivel.verify(**given)[1], "mirror": mirrored}.get(name, getattr(swivel, name))
        left = lambda name: lambda **given: Limbs().after(name, **given) if name in ("write", "write_doubles", "reset") else getattr(Limbs(), name)(**given)
        for body, table, call in ((STUB.body, FUNCTIONS, made), (crowd.body, METHODS, left)):
            calls = {each.name: {argument.arg for argument in (*each.args.args, *each.args.kwonlyargs)} - {"self", "out"} for each in body
                     if isinstance(each, ast.FunctionDef) and each.name != "__init__" and not each.decorator_list}
            self.assertEqual(set(calls) - ELSEWHERE, set(table))
            for name, (usual, others) in table.items():
                with self.subTest(name):
                    self.assertEqual(set(others), calls[name] - ({"group"} if name == "hands" else set()))
                    self.check(call(name), usual, others)

    def test_every_argument_of_regions(self):
        room = lambda region: region.room([(0.3, 0.2, 1), (1, 0.4, -0.2), (0.4, -0.5, 0.2), (-1, 0, 0.1), (0.5, 0.1, 0.2), (-0.7, 0.5, 0.5), (-0.3, 1, 0)])
        three = [*CONE, (-1, 1, 0)]
        self.check(lambda **given: room(cones(**given)), {"axes": three, "angles": 0.3}, {"axes": three[:2], "angles": (0.2, 0.3, 0.4), "closed": True})

        def of(name):
            def call(**given):
                region = cones(axes=CONE, angles=0.5)
                getattr(region, name)(**given)
                return room(region)
            return call
        self.check(of("add_polygon"), {"corners": np.eye(3)}, {"corners": np.diag((-1, -1, 1))})
        self.check(of("forbid"), {"axis": (0, 0, 1), "angle": 0.2}, {"axis": (1, 0, 0.2), "angle": 0.4})
        arc = [(-1, 0, 0), (-1, 0, 1), (-0.3, 1, 0)]
        self.check(of("add_directions"), {"directions": arc, "margin": 0.1}, {"directions": arc[:2], "margin": 0.2, "max_cones": 1})
        region = cones(axes=CONE, angles=0.5)
        self.assertEqual(region.room((0, 0.1, 1)), region.room([(0, 0.1, 1)])[0])
        self.assertIsInstance(region.room((0, 0.1, 1)), float)
        np.testing.assert_array_equal(room(region.mirrored().mirrored()), room(region))
        self.assertTrue(swivel.Crowd(Group(1, region=region)).features() & Feature.WITH_REGION)


# ---- bodies of a chain of five joints with an arm below it, and what cannot be made of them
PARENTS = [-1, 0, 1, 2, 3, 1, 5, 6, 5]
PLACES = np.float32([(0, 1, 0), (0, 0.5, 0), (0.2, 0, 0), (0.3, 0, 0), (0.25, 0, 0), (0, 0.1, 0), (0, 0.2, 0), (0, 0.1, 0), (0, 0, 0.1)])
SHOULDER, ELBOW, WRIST, SPINE, NECK, HEAD = 2, 3, 4, 5, 6, 7
ARM = BodyGroup(SHOULDER, ELBOW, WRIST, bend=(0, 0, 1), features=Feature.POLE_INCOMING)
FOOT = ARM._replace(features=ARM.features | Feature.WITH_HAND | Feature.WITH_EFFECTOR | Feature.WITH_PLANT | Feature.WITH_GROUND)
FITS = ARM._replace(features=ARM.features | Feature.WITH_PLANT | Feature.WITH_PELVIS_FIT)
HOLDS = ARM._replace(features=ARM.features | Feature.WITH_HAND | Feature.WITH_LINK, link=1)
HAND = ARM._replace(features=ARM.features | Feature.WITH_HAND)
LOOK = LookGroup([SPINE, NECK, HEAD])


def make(*groups, **options):
    return swivel.Crowd(groups, **{"skeleton": Skeleton(PARENTS, PLACES), "body_count": 1, **options})


REFUSED = [
    (TypeError, "expected whole numbers in a BodyGroup, got", lambda: make(ARM._replace(on_bad_input="x"))),
    (TypeError, "expected a number of limbs, (number of limbs, binding) or a Group, got", lambda: swivel.Crowd(Group(1, twist_bone_count="x"))),
    (ValueError, "twist_bone_count is 8; it is 0 to 7", lambda: swivel.Crowd(Group(1, features=Feature.WITH_HAND, twist_bone_count=8))),
    (ValueError, "twist bones need Feature.WITH_HAND", lambda: swivel.Crowd(Group(1, twist_bone_count=1))),
    (ValueError, "twist bones need Feature.WITH_HAND", lambda: swivel.solve((0, 0, 1), None, (1, 1), twist_bone_count=1)),
    (ValueError, "Feature.WORLD is not for a body's limb", lambda: make(ARM._replace(features=Feature.WORLD))),
    (ValueError, "Feature.WITH_RECORD is not for a free limb", lambda: swivel.Crowd(1, Feature.WITH_RECORD)),
    (TypeError, "plant: expected a Plant, got 0.1", lambda: make(ARM._replace(plant=0.1))),
    (TypeError, "ground: expected a Ground, got 0.1", lambda: make(FOOT._replace(ground=0.1))),
    (ValueError, "link is -1", lambda: make(HOLDS._replace(link=-1), PropGroup())),
    (ValueError, "look.joints is -1", lambda: make(LookGroup([-1]))),
    (ValueError, "there are 8 twist bones", lambda: make(HAND._replace(twist_bones=[WRIST] * 8))),
    *((ValueError, "the crowd def has no skeleton", lambda group=group: swivel.Crowd(group)) for group in (ARM, ShiftGroup(), PropGroup(), LOOK)),
    (ValueError, "group 0 is of free limbs, but the crowd def has a skeleton", lambda: make(Group(1))),
    (ValueError, "body_count is 3, but there is no skeleton; give it", lambda: swivel.Crowd(1, body_count=3)),
    (ValueError, "a skeleton, but no bodies; give at least one", lambda: make(ARM, body_count=0)),
    (TypeError, "skeleton: expected a Skeleton, got [", lambda: make(ARM, skeleton=PARENTS)),
    (ValueError, "elbow is -1", lambda: make(ARM._replace(elbow=-1))),
    (ValueError, "translations: expected shape (9, 3)", lambda: make(ARM, skeleton=Skeleton(PARENTS, PLACES[1:]))),
    (ValueError, "cones 0 and 1 are opposite", lambda: cones(axes=[(1, 0, 0), (-1, 0, 0)], angles=0.1)),
    (ValueError, "direction 0, (0, 0, 0), has no direction", lambda: Region().room((0, 0, 0))),
    (ValueError, "axes: expected shape (n, 3), got (3,)", lambda: cones(axes=(1, 0, 0), angles=0.1)),
    (ValueError, "the region allows nothing", lambda: swivel.Crowd(Group(1, region=Region()))),
    (ValueError, "pole_behind: expected shape (1, 3), or (3,) for all limbs, got (2,)", lambda: swivel.Crowd(Group(1, pole_behind=(0, 1)))),
    (ValueError, "pole_behind lies along the limb at rest", lambda: swivel.Crowd(Group(1, features=Feature.POLE_HALF_LINE, pole_behind=(0, 0, 1)))),
    (ValueError, "group 0 has a pole_behind, but not Feature.POLE_HALF_LINE", lambda: make(ARM._replace(pole_behind=(0, 1, 0)))),
    (TypeError, "region: expected a Region, got 3", lambda: swivel.Crowd(Group(1, region=3))),
    (TypeError, "unexpected keyword argument 'contact'", lambda: swivel.solve((0, 0, 1), None, (1, 1), contact=1)),
]


class Kinds(unittest.TestCase):
    def test_every_group_is_of_its_kind(self):
        two_arms = Skeleton([*PARENTS, 1, 9, 10], [*PLACES, (-0.2, 0, 0), (-0.3, 0, 0), (-0.25, 0, 0)])
        other = HOLDS._replace(shoulder=9, elbow=10, wrist=11, link=3)
        crowd = make(LOOK, FITS, ShiftGroup(), PropGroup(), other, skeleton=two_arms)
        self.assertEqual([crowd.kind(group) for group in range(5)], [Kind.LOOK, Kind.BODY_LIMB, Kind.SHIFT, Kind.PROP, Kind.BODY_LIMB])
        self.assertEqual([crowd.features(group) for group in (0, 1, 4)], [Feature(0), FITS.features, other.features])
        self.assertEqual(swivel.Crowd([1, 2]).kind(1), Kind.LIMB)
        self.assertEqual(swivel.field_kinds(Field.FLAGS), tuple(Kind))
        self.assertEqual(swivel.field_kinds(Field.LIFT), (Kind.BODY_LIMB,))

    def test_twist_bones_are_counted(self):
        crowd = swivel.Crowd([Group(2, features=Feature.WITH_HAND, twist_bone_count=3), Group(2, features=Feature.WITH_HAND)])
        self.assertEqual([crowd.component_count(Field.TWIST_BONES, group) for group in (0, 1)], [12, 0])
        arms = swivel.solve((0, 0, 1), None, (1, 1), hand=(0, 0, 0, 1), twist_bone_count=2)
        self.assertEqual(arms.twist_bones.shape, (1, 8))
        self.assertIsNone(swivel.solve((0, 0, 1), None, (1, 1), hand=(0, 0, 0, 1)).twist_bones)


class Refused(Refusals):
    def test_what_cannot_be_made(self):
        for error, text, call in REFUSED:
            self.refuses(error, text, call)

    def test_what_cannot_be_solved(self):
        rotations = np.tile(np.float32((0, 0, 0, 1)), (1, 9, 1))
        crowd, pose, holding = make(FITS, ShiftGroup()), Pose(rotations), make(HOLDS, PropGroup(joint=HEAD))
        self.refuses(ValueError, "the pose has no time", crowd.solve, pose=pose)
        self.refuses(ValueError, "time: expected shape (1,)", crowd.solve, pose=pose._replace(time=(1, 2)))
        self.refuses(ValueError, "support_rotation: expected shape (1, 4)", crowd.solve, pose=pose._replace(time=0, support_rotation=np.eye(3)))
        self.refuses(TypeError, "was: expected a Support, got None", crowd.change_support, None, Support())
        self.refuses(ValueError, "now.position: expected shape (1, 3), or (3,) for all bodies, got (2,)", crowd.change_support, Support(), Support((1, 2)))
        self.refuses(ValueError, "change_support: group 1 does not plant; create it with Feature.WITH_PLANT", crowd.change_support, Support(), Support(), 1)
        self.refuses(ValueError, "solved_goal is a result; write takes inputs and what is carried", crowd.write, Field.SOLVED_GOAL, np.zeros(7))
        self.refuses(ValueError, "name both", holding.solve, pose=pose, groups=[0])


if __name__ == "__main__":
    unittest.main()
