# SPDX-License-Identifier: MIT
# Types of the extension module; docstrings are the module's own. A test holds this file against it.
import builtins
import enum
from typing import Any, Mapping, Optional, Sequence, Union

import numpy as np
import numpy.typing as npt

_Floats = npt.NDArray[np.float32]
_Doubles = npt.NDArray[np.float64]
_Group = Union[int, tuple[int, Binding]]
_Frame = Mapping[str, npt.ArrayLike]

LANES: int

class Feature(enum.IntFlag):
    WORLD = 1 << 0
    JOINTS = 1 << 1
    WITH_HAND = 1 << 2
    POLE_DIRECTION = 1 << 3
    COMPACT = 1 << 4
    WITH_EFFECTOR = 1 << 5
    WITH_ANGLE = 1 << 6
    POLE_NORMAL = 1 << 7
    WITH_INCOMING = 1 << 8
    POLE_INCOMING = 1 << 9
    WITH_WEIGHTS = 1 << 10
    WITH_REACH = 1 << 11
    WITH_MOST_SWIVEL = 1 << 12
    WITH_FLEXION_LIMIT = 1 << 13
    WITH_SHOULDER_CONE = 1 << 14
    WITH_HUMERAL_TWIST = 1 << 15
    WITH_SHOULDER_BOX = 1 << 16
    WITH_HAND_CONE = 1 << 17
    WITH_FOREARM_TWIST = 1 << 18
    WITH_HAND_TWIST = 1 << 19
    WITH_WRIST_BOX = 1 << 20
    WITH_AIM = 1 << 21
    WITH_CLAVICLE = 1 << 22
    BUDGET = 1 << 23
    WITH_TWIST_BONES = 1 << 40

class Field(enum.IntEnum):
    TARGET = 0
    POLE = 1
    LENGTHS = 2
    SHOULDER_POSITION = 3
    PARENT_ROTATION = 4
    PARENT_SCALE = 5
    HAND = 6
    EFFECTOR = 7
    ANGLE = 8
    INCOMING_SHOULDER = 9
    INCOMING_ELBOW = 10
    INCOMING_WRIST = 11
    WEIGHTS = 12
    REACH = 13
    MOST_SWIVEL = 14
    FLEXION_LIMIT = 15
    SHOULDER_CONE = 16
    HUMERAL_TWIST = 17
    SHOULDER_BOX = 18
    HAND_CONE = 19
    FOREARM_TWIST = 20
    HAND_TWIST = 21
    WRIST_BOX = 22
    AIM = 23
    CLAVICLE = 24
    SHOULDER = 256
    ELBOW = 257
    WRIST = 258
    FLAGS = 259
    STRETCH = 260
    NORMAL = 261
    TWIST_BONES = 262
    CLAVICLE_TURN = 263

class Flag(enum.IntFlag):
    REACHED = 1 << 0
    SOFTENED = 1 << 1
    STRETCHED = 1 << 2
    CLAMPED_FAR = 1 << 3
    CLAMPED_NEAR = 1 << 4
    SWIVEL_UNDEFINED = 1 << 5
    LIMITED_FLEXION = 1 << 6
    LIMITED_SHOULDER_CONE = 1 << 7
    LIMITED_HUMERAL_TWIST = 1 << 8
    LIMITED_SHOULDER_BOX = 1 << 9
    LIMITED_HAND_CONE = 1 << 10
    LIMITED_FOREARM_TWIST = 1 << 11
    LIMITED_HAND_TWIST = 1 << 12
    LIMITED_WRIST_BOX = 1 << 13
    LIMITED_STEP = 1 << 14
    INFEASIBLE = 1 << 15
    JUMPED = 1 << 16
    BAD_INPUT = 1 << 30

class EulerOrder(enum.IntEnum):
    XYZ = 0
    XZY = 1
    YZX = 2
    YXZ = 3
    ZXY = 4
    ZYX = 5

class Binding:
    def __init__(self, *, parent_from_arm: npt.ArrayLike, upper_from_arm: npt.ArrayLike, elbow_parent_from_arm: npt.ArrayLike,
                 fore_from_arm: npt.ArrayLike, wrist_parent_from_arm: npt.ArrayLike, shoulder_rest: npt.ArrayLike,
                 elbow_rest: npt.ArrayLike, wrist_rest: npt.ArrayLike, lengths: npt.ArrayLike,
                 twist_parent_from_arm: npt.ArrayLike = (), twist_from_arm: npt.ArrayLike = ()) -> None: ...
    @property
    def parent_from_arm(self) -> _Floats: ...
    @property
    def upper_from_arm(self) -> _Floats: ...
    @property
    def elbow_parent_from_arm(self) -> _Floats: ...
    @property
    def fore_from_arm(self) -> _Floats: ...
    @property
    def wrist_parent_from_arm(self) -> _Floats: ...
    @property
    def shoulder_rest(self) -> _Floats: ...
    @property
    def elbow_rest(self) -> _Floats: ...
    @property
    def wrist_rest(self) -> _Floats: ...
    @property
    def lengths(self) -> _Floats: ...
    @property
    def twist_parent_from_arm(self) -> _Floats: ...
    @property
    def twist_from_arm(self) -> _Floats: ...

class Check:
    @property
    def name(self) -> str: ...
    @property
    def set(self) -> str: ...
    @property
    def arm_count(self) -> int: ...
    @property
    def max(self) -> float: ...
    @property
    def rms(self) -> float: ...
    @property
    def max_limit(self) -> float: ...
    @property
    def rms_limit(self) -> float: ...

class Crowd:
    def __init__(self, groups: Union[int, Sequence[_Group]], features: int = 0, shoulder_order: int = 0,
                 wrist_order: int = 0) -> None: ...
    @property
    def features(self) -> Feature: ...
    @property
    def group_count(self) -> int: ...
    @property
    def block_count(self) -> int: ...
    @property
    def lane_count(self) -> int: ...
    def limb_count(self, group: int = 0) -> int: ...
    def limbs(self, group: int = 0) -> builtins.range: ...
    def component_count(self, field: int) -> int: ...
    def rows(self, field: int) -> npt.NDArray[Any]: ...
    @property
    def input_rows(self) -> _Floats: ...
    @property
    def result_rows(self) -> _Floats: ...
    @property
    def compact_rows(self) -> npt.NDArray[np.uint16]: ...
    def write(self, field: int, values: npt.ArrayLike, group: int = 0, first: int = 0, count: Optional[int] = None) -> None: ...
    def write_doubles(self, field: int, values: npt.ArrayLike, origins: Optional[npt.ArrayLike] = None, group: int = 0,
                      first: int = 0, count: Optional[int] = None) -> None: ...
    def read(self, field: int, group: int = 0, first: int = 0, count: Optional[int] = None,
             out: Optional[npt.NDArray[Any]] = None) -> npt.NDArray[Any]: ...
    def solve(self, *, blocks: Optional[tuple[int, int]] = None, mask: Optional[npt.NDArray[np.bool_]] = None,
              limbs: Optional[npt.ArrayLike] = None, priorities: Optional[Sequence[npt.ArrayLike]] = None,
              most_blocks: Optional[int] = None, frames: Union[_Frame, Sequence[_Frame], None] = None,
              on_this_thread: bool = False) -> int: ...
    def choose(self, priorities: Sequence[npt.ArrayLike], most_blocks: int) -> npt.NDArray[np.bool_]: ...
    def reset(self, group: int = 0, first: int = 0, count: Optional[int] = None) -> None: ...
    def elbows(self, group: int = 0, first: int = 0, count: Optional[int] = None, out: Optional[_Doubles] = None) -> _Doubles: ...
    def wrists(self, group: int = 0, first: int = 0, count: Optional[int] = None, out: Optional[_Doubles] = None) -> _Doubles: ...
    def hands(self, group: int = 0, first: int = 0, count: Optional[int] = None, out: Optional[_Doubles] = None) -> _Doubles: ...
    def residuals(self, group: int = 0, first: int = 0, count: Optional[int] = None,
                  out: Optional[_Doubles] = None) -> _Doubles: ...
    def joint_angles(self, shoulder_order: int = 0, wrist_order: int = 0, family: int = 0, group: int = 0, first: int = 0,
                     count: Optional[int] = None, out: Optional[_Doubles] = None) -> _Doubles: ...
    def find(self, flags: int, group: int = 0, limb: int = 0) -> Optional[tuple[int, int]]: ...
    def explain(self, *, limb: int, group: int = 0) -> str: ...
    def digest(self) -> int: ...
    def allowed_arcs(self, limb: int, group: int = 0) -> _Floats: ...

def range(least: float, most: float) -> _Floats: ...
def arm_axis(binding: Binding, parent_rotation: npt.ArrayLike, direction: npt.ArrayLike) -> _Doubles: ...
def cone(axis: npt.ArrayLike, most: float) -> _Floats: ...
def flexion(least: float, most: float) -> _Floats: ...
def turn(angle: float) -> _Floats: ...
def aim(axis: npt.ArrayLike, flexion: float) -> _Floats: ...
def mirror(field: int, values: npt.ArrayLike, order: int = 0) -> _Floats: ...
def needed_features(field: int) -> Feature: ...
def bind(elbow_offset: npt.ArrayLike, wrist_offset: npt.ArrayLike, bend: npt.ArrayLike = (0, 0, 0),
         shoulder_rotation: npt.ArrayLike = (0, 0, 0, 1), elbow_rotation: npt.ArrayLike = (0, 0, 0, 1),
         wrist_rotation: npt.ArrayLike = (0, 0, 0, 1)) -> Binding: ...
def bind_joints(parents: npt.ArrayLike, translations: npt.ArrayLike, shoulder: int, elbow: int, wrist: int,
                rotations: Optional[npt.ArrayLike] = None, twist_bones: Sequence[int] = (),
                bend: npt.ArrayLike = (0, 0, 0)) -> Binding: ...
def version() -> tuple[int, int, int]: ...
def isa_name() -> str: ...
def use_isa(name: str) -> None: ...
def isas() -> list[tuple[str, bool]]: ...
def verify(arm_count: int = 10000, seed: int = 1) -> tuple[bool, list[Check]]: ...
def unpack_rotations(words: npt.ArrayLike) -> _Floats: ...
