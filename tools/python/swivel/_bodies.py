# SPDX-License-Identifier: MIT
"""What a crowd of bodies is made of, and what it solves."""
from typing import NamedTuple, Optional, Sequence

import numpy as np
import numpy.typing as npt

from ._core import EulerOrder, OnBadInput, PoseSpace, Region


class Skeleton(NamedTuple):
    """A skeleton at rest, which all bodies of a Crowd have. Joints are in any order.

    parents       (joints,) each joint's parent, -1 for a root
    translations  (joints, 3) its place in its parent's frame
    rotations     (joints, 4) relative to its parent, x, y, z, w; None: no joint is turned at rest
    """

    parents: npt.ArrayLike
    translations: npt.ArrayLike
    rotations: Optional[npt.ArrayLike] = None


class Plant(NamedTuple):
    """How the limbs of a BodyGroup with Feature.WITH_PLANT stand: each plants its effector, or without one its wrist.

    Lengths are in limb lengths: both bones of the skeleton at rest, times the root's scale. Times are in seconds.

    lock_radius    a point locks only within this of where it is animated
    unlock_radius  a locked point is released if the animation has it further away
    stop_time      a point that locks is at rest after this time
    release_time   a point that is released is with the animation again after this time
    relock_speed   lengths a second: after a release by distance a slower point locks anew; 0: none does
    anchor_lead    0: it is anchored where it locks, 1: where it would come to rest by itself; 0.5 slides least
    reset_time     a body that was not solved for longer than this starts anew; 0: none does
    speed          with Feature.PLANT_BY_MOTION: lengths a second below which a contact begins, and goes on
    height         the same of the height over the root, along the crowd's `up`
    """

    lock_radius: float = 0.12
    unlock_radius: float = 0.24
    stop_time: float = 0.1
    release_time: float = 0.2
    relock_speed: float = 0.06
    anchor_lead: float = 0.5
    reset_time: float = 0
    speed: Sequence[float] = (0.6, 0.8)
    height: Sequence[float] = (0.08, 0.1)


class Ground(NamedTuple):
    """How the feet of a BodyGroup with Feature.WITH_GROUND stand on ground as it lies: their effectors are the toes.

    Clearances are heights over the ground, in the bones' unit.

    heel            (3,) a point of the sole in the wrist joint's frame, in the bones' unit; zeros: the wrist itself
    toe_clearance   of the effector where it stands
    heel_clearance  of the heel where it stands; 0 for both if both are on the sole
    cos_max         cosine of the angle that the foot turns at most, 0 to 1
    half_life       seconds in which about half of a lift is made up
    """

    heel: npt.ArrayLike = (0, 0, 0)
    toe_clearance: float = 0
    heel_clearance: float = 0
    cos_max: float = 0.8
    half_life: float = 0.05


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


class ShiftGroup(NamedTuple):
    """The shift of each body along the crowd's `up`, so that its limbs with Feature.WITH_PELVIS_FIT reach. One of a Crowd's groups.

    It has no features and names no joints. Field.SHIFT[0] is by how much the root, or the pelvis, moves.

    drop       the most down, in lengths of the first limb with Feature.WITH_PELVIS_FIT (see Plant)
    rise       the most up
    half_life  seconds in which about half of a distance is made up
    lookahead  seconds from when on Field.NEXT_TARGET counts; at 0 seconds it counts whole
    """

    drop: float = 0.1
    rise: float = 0.05
    half_life: float = 0.1
    lookahead: float = 0.3


class PropGroup(NamedTuple):
    """A thing that one hand or two of each body hold, such as a rifle or a ladder: BodyGroups with Feature.WITH_LINK. One of a Crowd's groups.

    It is no limb and has no features. Field.PROP_POSITION and Field.PROP_ROTATION say where it is, or else its joint, or else the
    hands of the incoming pose. It moves as little as it must so that all hands reach. Field.PROP_TRANSFORM is where it then is.

    joint     of the skeleton, which no limb turns; -1: none
    max_move  the most that it moves, in lengths of the first limb that is linked to it; 0: it stays, as a ladder does
    """

    joint: int = -1
    max_move: float = 1


class LookGroup(NamedTuple):
    """A chain of joints of each body that looks: a line of sight in the last joint meets Field.LOOK_TARGET. One of a Crowd's groups.

    It is no limb and has no features. It comes after the shift and before all props and limbs, so limbs may hang below it. An
    eye is a LookGroup of one joint, after that of the head. Field.SIGHT is where the line then is: its start and its direction.

    joints        1 to 8 of the skeleton, each below the one before, such as spine, neck and head
    share         (joints,) of what is left of the turn, against those after it; a number: the same of all
    cos_max      (joints,) cosine of the angle that each turns at most, -1 to 1; a number: the same of all
    eye           (3,) where the line starts, in the last joint's frame, in its unit
    axis          (3,) where it points, in the last joint's frame, of any length but 0
    cos_full      the look fades as the target goes behind: from this cosine between line and target
    cos_none      to this one, at which the pose stays
    fade_distance it also fades nearer than this, in the last joint's unit
    rate          radians a second that the line turns at most; 0: it is not eased, and the pose needs no time
    """

    joints: Sequence[int]
    share: npt.ArrayLike = 1
    cos_max: npt.ArrayLike = 0.7
    eye: npt.ArrayLike = (0, 0, 0)
    axis: npt.ArrayLike = (0, 0, 1)
    cos_full: float = -0.1
    cos_none: float = -0.9
    fade_distance: float = 0.05
    rate: float = 6


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
    translations      (bodies, joints, 3) each joint's place in its parent's frame; None: as the skeleton rests
    scales            (bodies, joints, 3) uniform within a thousandth; None: 1
    root_position     (bodies, 3) what joints without a parent hang below, in the world; None: the origin
    root_rotation     (bodies, 4) None: not turned
    root_scale        (bodies,) None: 1
    out               where turned joints go, in the shape of the rotations or matrices; None: back to these
    space             PoseSpace.IN_BODY: rotations, translations, scales and matrices are relative to the root, not to parents
    out_translations  in the body's space: where translations of moved joints go; None: back to translations
    joint_rotations   (bodies, joints, 4) to write: how joints are turned after the solve, relative to the root
    joint_positions      (bodies, joints, 3) to write: where they are then
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
    crowds kilometres from the origin. Positions that streams leave out, and places among results, are then counted from the root.
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
