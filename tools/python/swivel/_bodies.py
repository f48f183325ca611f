# SPDX-License-Identifier: MIT
"""What a crowd of bodies is made of, and what it solves."""
from typing import NamedTuple, Optional, Sequence

import numpy as np
import numpy.typing as npt

from ._core import EulerOrder, Ground, OnBadInput, Plant, PoseSpace, Region


class Skeleton(NamedTuple):
    """A skeleton at rest, which all bodies of a Crowd have. Joints are in any order.

    parents       (joints,) each joint's parent, -1 for a root
    translations  (joints, 3) its position in its parent's frame
    rotations     (joints, 4) relative to its parent, x, y, z, w; None: no joint is turned at rest
    """

    parents: npt.ArrayLike
    translations: npt.ArrayLike
    rotations: Optional[npt.ArrayLike] = None


class BodyGroup(NamedTuple):
    """A limb of each body, for a Crowd with a skeleton. Features, on_bad_input and orders: None is as the crowd says for all groups.

    It is in the world and has an incoming pose, so it takes no Feature.WORLD and Feature.WITH_INCOMING, nor Feature.JOINTS.

    shoulder        joint of the skeleton; the elbow is below it, the wrist below the elbow
    elbow           joints in between keep their own rotations
    wrist           turned with Feature.WITH_HAND alone
    bend            (3,) where flexion carries the forearm, in the shoulder joint's frame; zeros: as the rest pose is bent
    twist_bones     joints below the elbow that share the hand's twist, from elbow to wrist; they need Feature.WITH_HAND
    features        members of Feature, combined with |
    on_bad_input    what a limb with bad input gets
    shoulder_order  of Field.SHOULDER_BOX
    wrist_order     of Field.WRIST_BOX
    plant           for Feature.WITH_PLANT
    ground          for Feature.WITH_GROUND
    link            for Feature.WITH_LINK: the number of the group that it holds, a PropGroup or an earlier BodyGroup
    region          where the upper limb may point; it brings Feature.WITH_REGION
    pole_behind     as Group's
    """

    shoulder: int
    elbow: int
    wrist: int
    bend: npt.ArrayLike = (0, 0, 0)
    twist_bones: Sequence[int] = ()
    features: Optional[int] = None
    on_bad_input: Optional[OnBadInput] = None
    shoulder_order: Optional[EulerOrder] = None
    wrist_order: Optional[EulerOrder] = None
    plant: Plant = Plant()
    ground: Ground = Ground()
    link: Optional[int] = None
    region: Optional[Region] = None
    pole_behind: npt.ArrayLike = (0, 0, 0)


class Support(NamedTuple):
    """What planted points stand on, for Crowd.change_support(): a platform, a ladder, the ground.

    position  (bodies, 3), or (3,) for all, float64, in the world; None: the origin
    rotation  (bodies, 4), or (4,) for all; None: not turned
    """

    position: Optional[npt.ArrayLike] = None
    rotation: Optional[npt.ArrayLike] = None


class Pose(NamedTuple):
    """The poses of all bodies, for Crowd.solve(), which reads them and writes the joints that it turns.

    rotations         (bodies, joints, 4) x, y, z, w, each joint's relative to its parent
    matrices          (bodies, joints, 3, 4) or (bodies, joints, 4, 4) instead of rotations, translations and scales
    translations      (bodies, joints, 3) each joint's position in its parent's frame; None: as the skeleton rests
    scales            (bodies, joints, 3) uniform within a thousandth; None: 1
    root_position     (bodies, 3) what joints without a parent hang below, in the world; None: the origin
    root_rotation     (bodies, 4) None: not turned
    root_scale        (bodies,) None: 1
    out               where turned joints go, in the shape of the rotations or matrices; None: back to these
    space             PoseSpace.IN_BODY: rotations, translations, scales and matrices are relative to the root, not to parents
    out_translations  in the body's space: where translations of moved joints go; None: back to translations
    joint_rotations   (bodies, joints, 4) to write: how joints are turned after the solve, relative to the root
    joint_positions   (bodies, joints, 3) to write: where they are then, in the frame of the root before its shift
    time              (bodies,) seconds since the body's last solve; planted limbs, shifts and looks with a rate need it
    support_position  (bodies, 3) of what planted points stand on, in the world; None: the origin
    support_rotation  (bodies, 4) None: not turned
    weight            (bodies,) 0 to 1, how much of all corrections counts: 0 keeps the incoming pose; None: 1

    Values that are the same for all bodies may lack the first axis. What is written is an array of float32, with the numbers of
    a value side by side and any distances between joints and bodies. Matrices may also be transposed views of such. Joints that
    are not turned are not written, and neither is the last row of a matrix: start `out` as a copy. What is only read may be
    anything that NumPy makes an array of, which is copied first if it lies differently.

    In the body's space all joints below a limb's move with it, and are written, too, translations among them. joint_rotations
    and joint_positions get the joints that some limb needs: its own, those in between, and all above. Others keep their numbers.

    A root_position that is an array of float64 makes support_position and all positions in streams float64. The root is subtracted in double, for
    crowds kilometres from the origin. Positions that streams leave out, and all positions among results, are then relative to the root.

    All positions hold for the root before its shift, so results have Field.SHIFT in them already. Draw the pose with it added to the root's
    position.
    """

    rotations: Optional[npt.ArrayLike] = None
    matrices: Optional[npt.ArrayLike] = None
    translations: Optional[npt.ArrayLike] = None
    scales: Optional[npt.ArrayLike] = None
    root_position: Optional[npt.ArrayLike] = None
    root_rotation: Optional[npt.ArrayLike] = None
    root_scale: Optional[npt.ArrayLike] = None
    out: Optional[npt.NDArray[np.float32]] = None
    space: PoseSpace = PoseSpace.LOCAL
    out_translations: Optional[npt.NDArray[np.float32]] = None
    joint_rotations: Optional[npt.NDArray[np.float32]] = None
    joint_positions: Optional[npt.NDArray[np.float32]] = None
    time: Optional[npt.ArrayLike] = None
    support_position: Optional[npt.ArrayLike] = None
    support_rotation: Optional[npt.ArrayLike] = None
    weight: Optional[npt.ArrayLike] = None
