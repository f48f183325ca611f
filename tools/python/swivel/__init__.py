# SPDX-License-Identifier: MIT
"""swivel solves the arms of crowds: wrist targets and elbow poles in, joint rotations out, with the same bits on every CPU.

solve() takes plain arrays and gives named ones. A Crowd keeps the limbs from frame to frame and has everything else:

    crowd = swivel.Crowd(1000)
    crowd.write(swivel.Field.TARGET, targets)       # (1000, 3) float32, your unit of length
    crowd.write(swivel.Field.LENGTHS, (0.30, 0.26))  # one value for all limbs
    crowd.solve()
    shoulder = crowd.read(swivel.Field.SHOULDER)    # (1000, 4) quaternions x, y, z, w

At rest an arm lies along +z of its frame and bends towards +y, its hinge is +x, and the elbow lies on the pole's side. Mistakes
are ValueError, TypeError, MemoryError and RuntimeError; hard poses are results with a Flag.
"""
# Annotations of Plant, Ground and the groups of the module are texts with the names Sequence and npt. typing.get_type_hints() looks for them here.
from typing import Sequence

import numpy.typing as npt

from ._arms import solve
from ._bodies import BodyGroup, Pose, Skeleton, Support
from ._core import (LANES, Arms, Binding, Check, Crowd, Entity, EulerOrder, Feature, Field, Flag, Ground, Kind, LookGroup, OnBadInput, Plant, PoseSpace,
                    PropGroup, Region, ShiftGroup, aim, arm_axis, bind_joints, blade_name, cone, cos_sin, field_kinds, fill_cache, flexion, isa_name, isas,
                    mirror, needed_features, range, steps, unpack_rotations, use_isa, verify, version)
from ._groups import Group

__version__ = ".".join(map(str, version()))
__all__ = ["LANES", "Arms", "Binding", "BodyGroup", "Check", "Crowd", "Entity", "EulerOrder", "Feature", "Field", "Flag", "Ground", "Group", "Kind", "LookGroup",
           "OnBadInput", "Plant", "Pose", "PoseSpace", "PropGroup", "Region", "ShiftGroup", "Skeleton", "Support", "aim", "arm_axis", "bind_joints", "blade_name", "cone", "cos_sin", "field_kinds", "fill_cache", "flexion", "isa_name",
           "isas", "mirror", "needed_features", "range", "solve", "steps", "unpack_rotations", "use_isa", "verify", "version"]
