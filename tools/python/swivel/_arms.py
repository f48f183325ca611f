# SPDX-License-Identifier: MIT
"""One call for people with plain arrays: a crowd is made, solved, read and dropped."""
from typing import Optional

import numpy as np
import numpy.typing as npt

from ._core import Arms, Binding, Crowd, EulerOrder, Feature, Field, Kind, field_kinds, needed_features
from ._groups import Group


def _is_input(field: Field) -> bool:
    """Whether free limbs have the input."""
    return field < Field.SHOULDER and Kind.LIMB in field_kinds(field)


def _field(name: str) -> Field:
    field = Field.__members__.get(name.upper())
    if field is None or not name.islower() or not _is_input(field):
        inputs = ", ".join(each.name.lower() for each in Field if _is_input(each))
        raise TypeError(f"solve() got an unexpected keyword argument '{name}'; beside its own it takes the input fields {inputs}")
    return field


def _limb_count(group: Group, values: dict[Field, npt.NDArray[np.generic]]) -> int:
    """The length of the first array that has a value for each limb; 1 if there is none."""
    one = Crowd(group)
    for field, array in values.items():
        if array.ndim == (2 if one.component_count(field) > 1 else 1):
            return len(array)
    return 1


def solve(target: npt.ArrayLike, pole: Optional[npt.ArrayLike], lengths: Optional[npt.ArrayLike] = None, *, features: int = 0,
          binding: Optional[Binding] = None, origin: Optional[npt.ArrayLike] = None,
          shoulder_order: EulerOrder = EulerOrder.XYZ, wrist_order: EulerOrder = EulerOrder.XYZ, twist_bone_count: int = 0,
          **fields: npt.ArrayLike) -> Arms:
    """Solves n arms, each on its own, and gives their rotations, flags and positions by name.

    target (n, 3): where the wrists must be. pole (n, 3): points on the elbows' side; None leaves the one there is at creation.
    lengths (n, 2): upper arm and forearm; None takes the binding's. Any of them may be one value, (3,) or (2,), for all arms. All in one unit of length,
    seen from the shoulder, or in the world with shoulder_position=. Anything that NumPy makes an array of will do.

    Further keywords are the input fields' lower-case names, and bring the features they need: hand=, parent_rotation=, reach=,
    shoulder_cone=, ...; docs/fields.md lists them, and docs/python.md says how they are shaped. features adds those without a field,
    such as Feature.POLE_DIRECTION. binding, from bind_joints(), makes the results a skeleton's own local rotations. origin (n, 3) or (3,): all
    positions are taken from there in double precision. twist_bone_count, with hand=, is how many bones share the hand's twist.

    No arms, arrays of length 0, give none. ValueError for shapes that do not go together, for lengths that nobody gave and for a
    world without shoulder_position=, TypeError for a keyword that is no input field.
    """
    given = {"target": target, **{name: value for name, value in (("pole", pole), ("lengths", lengths)) if value is not None},
             **fields}
    if lengths is None and binding is None:
        raise ValueError("solve() needs the bones' lengths; give lengths= or binding=")
    values = {_field(name): np.asarray(value) for name, value in given.items()}
    wanted = Feature(features) | (Feature.JOINTS if binding else Feature(0))
    for field in values:
        wanted |= needed_features(field)
    if Feature.WORLD in wanted and Field.SHOULDER_POSITION not in values:
        raise ValueError("solve() needs to know where the shoulders are in the world; give shoulder_position=")
    one = Group(1, binding, wanted, shoulder_order=shoulder_order, wrist_order=wrist_order, twist_bone_count=twist_bone_count)
    n = _limb_count(one, values)
    crowd = Crowd(one._replace(limb_count=max(n, 1)))  # a group has limbs; of no arms, the one's results are left out
    streams: dict[str, npt.ArrayLike] = {field.name.lower(): array for field, array in values.items()}
    if origin is not None:
        streams["origin"] = origin
    crowd.solve(streams=streams if n > 0 else None)
    results = {field.name.lower(): crowd.read(field)
               for field in Field if field >= Field.SHOULDER and crowd.component_count(field) > 0}
    results.update(elbow_position=crowd.elbows(), wrist_position=crowd.wrists(), residual=crowd.residuals())
    return Arms(**{name: values[:n] for name, values in results.items()})
