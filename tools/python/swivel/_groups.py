# SPDX-License-Identifier: MIT
"""What a crowd is made of."""
from typing import NamedTuple, Optional

import numpy.typing as npt

from ._core import Binding, EulerOrder, OnBadInput, Region


class Group(NamedTuple):
    """Free limbs that share features and a binding, for Crowd. None: as the crowd says for all of its groups.

    limb_count        1 or more
    binding           from bind_joints(); Feature.JOINTS needs it
    features          members of Feature, combined with |
    on_bad_input      what a limb with bad input gets
    shoulder_order    of Field.SHOULDER_BOX
    wrist_order       of Field.WRIST_BOX
    region            where the upper arms may point; it brings Feature.WITH_REGION
    twist_bone_count  bones that share the hand's twist, 0 to 7; more than 0 with Feature.WITH_HAND
    pole_behind       (3,) for Feature.POLE_HALF_LINE: where no wrist goes, in the frame of the shoulder's parent; zeros: where
                      elbows point at rest
    """

    limb_count: int
    binding: Optional[Binding] = None
    features: Optional[int] = None
    on_bad_input: Optional[OnBadInput] = None
    shoulder_order: Optional[EulerOrder] = None
    wrist_order: Optional[EulerOrder] = None
    region: Optional[Region] = None
    twist_bone_count: int = 0
    pole_behind: npt.ArrayLike = (0, 0, 0)
