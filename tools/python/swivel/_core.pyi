# SPDX-License-Identifier: MIT
# Types of the extension module; docstrings are the module's own. A test holds this file against it.
import builtins
import enum
from typing import Any, Mapping, Optional, Sequence, Union

import numpy as np
import numpy.typing as npt

_Floats = npt.NDArray[np.float32]
_Doubles = npt.NDArray[np.float64]
_Group = Union[int, tuple[int, Union[Binding, BoundLimb]]]
_Frame = Mapping[str, npt.ArrayLike]

LANES: int

class Feature(enum.IntFlag):
    WORLD: int
    JOINTS: int
    WITH_HAND: int
    POLE_DIRECTION: int
    COMPACT: int
    WITH_EFFECTOR: int
    WITH_ANGLE: int
    POLE_NORMAL: int
    WITH_INCOMING: int
    POLE_INCOMING: int
    WITH_WEIGHTS: int
    WITH_REACH: int
    WITH_STEP: int
    LIMIT_FLEXION: int
    LIMIT_SHOULDER_CONE: int
    LIMIT_HUMERAL_TWIST: int
    LIMIT_SHOULDER_BOX: int
    LIMIT_HAND_CONE: int
    LIMIT_FOREARM_TWIST: int
    LIMIT_HAND_TWIST: int
    LIMIT_WRIST_BOX: int
    TWIST_BONES: int
    WITH_AIM: int
    WITH_CLAVICLE: int
    BUDGET: int 

class Field(enum.IntEnum):
    TARGET: int
    POLE: int
    LENGTHS: int
    PARENT_POSITION: int
    PARENT_ROTATION: int
    PARENT_SCALE: int
    HAND: int
    EFFECTOR: int
    ANGLE: int
    INCOMING_SHOULDER: int
    INCOMING_ELBOW: int
    INCOMING_WRIST: int
    WEIGHTS: int
    REACH: int
    MOST_SWIVEL: int
    FLEXION_LIMIT: int
    SHOULDER_CONE: int
    HUMERAL_TWIST: int
    SHOULDER_BOX: int
    HAND_CONE: int
    FOREARM_TWIST: int
    HAND_TWIST: int
    WRIST_BOX: int
    AIM: int
    CLAVICLE: int
    SHOULDER: int
    ELBOW: int
    WRIST: int
    FLAGS: int
    STRETCH: int
    NORMAL: int
    TWIST: int
    CLAVICLE_TURN: int 

class Flag(enum.IntFlag):
    REACHED: int
    SOFTENED: int
    STRETCHED: int
    CLAMPED_FAR: int
    CLAMPED_NEAR: int
    SWIVEL_UNDEFINED: int
    LIMITED_FLEXION: int
    LIMITED_SHOULDER_CONE: int
    LIMITED_HUMERAL_TWIST: int
    LIMITED_SHOULDER_BOX: int
    LIMITED_HAND_CONE: int
    LIMITED_FOREARM_TWIST: int
    LIMITED_HAND_TWIST: int
    LIMITED_WRIST_BOX: int
    LIMITED_STEP: int
    INFEASIBLE: int
    JUMPED: int
    BAD_INPUT: int 

class EulerOrder(enum.IntEnum):
    XYZ: int
    XZY: int
    YZX: int
    YXZ: int
    ZXY: int
    ZYX: int 

class Binding:
    def __init__(self, *, parent_from_arm: npt.ArrayLike, upper_from_arm: npt.ArrayLike, fore_from_arm: npt.ArrayLike,
                 shoulder_rest: npt.ArrayLike, elbow_rest: npt.ArrayLike, wrist_rest: npt.ArrayLike) -> None: ...
    @property
    def parent_from_arm(self) -> _Floats: ...
    @property
    def upper_from_arm(self) -> _Floats: ...
    @property
    def fore_from_arm(self) -> _Floats: ...
    @property
    def shoulder_rest(self) -> _Floats: ...
    @property
    def elbow_rest(self) -> _Floats: ...
    @property
    def wrist_rest(self) -> _Floats: ...

class BoundLimb:
    @property
    def binding(self) -> Binding: ...
    @property
    def lengths(self) -> _Floats: ...

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
    def solve_frame(self, frames: Union[_Frame, Sequence[_Frame]]) -> None: ...
    def solve_frame_blocks(self, frames: Union[_Frame, Sequence[_Frame]], first: int, count: int) -> None: ...
    def solve(self) -> None: ...
    def solve_blocks(self, first: int, count: int) -> None: ...
    def solve_active(self, active: npt.NDArray[np.bool_]) -> None: ...
    def solve_active_blocks(self, active: npt.NDArray[np.bool_], first: int, count: int) -> None: ...
    def solve_list(self, lanes: npt.ArrayLike) -> None: ...
    def choose(self, priorities: Sequence[npt.ArrayLike], most_blocks: int) -> npt.NDArray[np.bool_]: ...
    def solve_budget(self, priorities: Sequence[npt.ArrayLike], most_blocks: int) -> int: ...
    def reset(self, group: int = 0, first: int = 0, count: Optional[int] = None) -> None: ...
    def elbows(self, group: int = 0, first: int = 0, count: Optional[int] = None, out: Optional[_Doubles] = None) -> _Doubles: ...
    def wrists(self, group: int = 0, first: int = 0, count: Optional[int] = None, out: Optional[_Doubles] = None) -> _Doubles: ...
    def hands(self, group: int = 0, first: int = 0, count: Optional[int] = None, out: Optional[_Doubles] = None) -> _Doubles: ...
    def residuals(self, group: int = 0, first: int = 0, count: Optional[int] = None,
                  out: Optional[_Doubles] = None) -> _Doubles: ...
    def joint_angles(self, shoulder_order: int = 0, wrist_order: int = 0, family: int = 0, group: int = 0, first: int = 0,
                     count: Optional[int] = None, out: Optional[_Doubles] = None) -> _Doubles: ...
    def allowed_arcs(self, limb: int, group: int = 0) -> _Floats: ...

def range(least: float, most: float) -> _Floats: ...
def cone(axis: npt.ArrayLike, most: float) -> _Floats: ...
def flexion(least: float, most: float) -> _Floats: ...
def turn(angle: float) -> _Floats: ...
def aim(axis: npt.ArrayLike, flexion: float) -> _Floats: ...
def mirror(field: int, values: npt.ArrayLike, order: int = 0) -> _Floats: ...
def needed_features(field: int) -> Feature: ...
def bind(elbow_offset: npt.ArrayLike, wrist_offset: npt.ArrayLike, hinge: npt.ArrayLike = (0, 0, 0),
         shoulder_rotation: npt.ArrayLike = (0, 0, 0, 1), elbow_rotation: npt.ArrayLike = (0, 0, 0, 1),
         wrist_rotation: npt.ArrayLike = (0, 0, 0, 1)) -> BoundLimb: ...
def version() -> tuple[int, int, int]: ...
def isa_name() -> str: ...
def use_isa(name: str) -> None: ...
def isas() -> list[tuple[str, bool]]: ...
def verify(arm_count: int = 10000, seed: int = 1) -> tuple[bool, list[Check]]: ...
def unpack_rotations(words: npt.ArrayLike) -> _Floats: ...
