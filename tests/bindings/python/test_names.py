# SPDX-License-Identifier: MIT
"""The promise: the module has every name of the headers, its stub and its documentation say what it has, and everything public explains itself,
arrays with their shapes. The documentation's programs run as they stand there, and what they ask for is reached."""
import ast
import contextlib
import inspect
import io
import json
import re
import subprocess
import sys
import tempfile
import typing
import unittest
from pathlib import Path

import numpy as np

import swivel
from figures import LIMBS, PARENTS, PLACES, crowd_of, flags_of
from swivel import Feature, Field, Flag, Kind

ROOT = Path(__file__).resolve().parents[3]
PACKAGE = Path(swivel.__file__).parent  # as built, with the stub
STUB = ast.parse((PACKAGE / "_core.pyi").read_text(encoding="utf-8"))
DOCS = (ROOT / "docs" / "python.md").read_text(encoding="utf-8")
FIELDS = (ROOT / "docs" / "fields.md").read_text(encoding="utf-8")
PROGRAM = r"```python\n(.*?)```"


def described(kind):
    """Of all public headers."""
    headers = json.loads((ROOT / "tools/headers/headers.json").read_text(encoding="utf-8"))
    return {name: each for header in ("swivel", "swivel_bodies", "swivel_regions", "swivel_explain") for name, each in headers[header][kind].items()}


def header_enum(name):
    """Names and values of a C enum, without SWIVEL_ and the numbers that end a range."""
    return {key.removeprefix("SWIVEL_").removeprefix("KIND_"): value for key, value in described("enumerations")[name].items() if not key.endswith("_END")}


def crowd_with(field, features):
    """A crowd of one limb, or of one body for what bodies alone have; and the number of the group that may have the field, with these features."""
    kind, skeleton = swivel.field_kinds(field)[0], swivel.Skeleton(PARENTS, PLACES)
    if kind == Kind.LIMB:
        return swivel.Crowd(swivel.Group(1, features=features, twist_bone_count=int(field == Field.TWIST_BONES))), 0
    if kind == Kind.SHIFT:
        return crowd_of(1, Feature.WITH_PELVIS_FIT), 2
    if kind == Kind.LOOK:
        return swivel.Crowd(swivel.LookGroup([0]), skeleton=skeleton, body_count=1), 0
    if kind == Kind.PROP:
        features |= Feature.WITH_HAND | Feature.WITH_LINK  # of what holds it
    if features & Feature.WITH_LINK:
        hand = swivel.BodyGroup(*LIMBS[0], bend=(0, 0, 1), features=features, link=1)
        return swivel.Crowd([hand, swivel.PropGroup()], skeleton=skeleton, body_count=1), int(kind == Kind.PROP)
    return crowd_of(1, features | (Feature.WITH_PLANT if field == Field.SOLVED_GOAL else 0)), 0  # which is sent somewhere


def public(node):
    return isinstance(node, (ast.FunctionDef, ast.ClassDef)) and (node.name[0] != "_" or node.name == "__init__")


def is_property(node):
    return any(isinstance(each, ast.Name) and each.id == "property" for each in node.decorator_list)


def parameters(function):
    """Names, defaults and kinds, as one text for each parameter but self."""
    arguments = function.args
    plain = arguments.posonlyargs + arguments.args
    defaults = [None] * (len(plain) - len(arguments.defaults)) + arguments.defaults
    pairs = [*zip(plain, defaults), *[("*", None)] * bool(arguments.kwonlyargs), *zip(arguments.kwonlyargs, arguments.kw_defaults)]
    return [pair[0] if pair[0] == "*" else pair[0].arg + (f"={ast.unparse(pair[1])}" if pair[1] else "")
            for pair in pairs if pair[0] == "*" or pair[0].arg != "self"]


class Names(unittest.TestCase):
    def test_every_enumerator_of_the_header(self):
        for name, enum in (("swivel_features", swivel.Feature), ("swivel_field", Field), ("swivel_flag", swivel.Flag),
                           ("swivel_euler_order", swivel.EulerOrder), ("swivel_on_bad_input", swivel.OnBadInput),
                           ("swivel_pose_space", swivel.PoseSpace), ("swivel_kind", Kind)):
            wanted = header_enum(name)
            self.assertGreater(len(wanted), 1)
            self.assertEqual({each.name: each.value for each in enum}, wanted, f"swivel.{enum.__name__} beside {name}")
            stub = next(node for node in STUB.body if isinstance(node, ast.ClassDef) and node.name == enum.__name__)
            # Names alone, `A: int`, would be attributes of each member to a type checker.
            self.assertEqual({node.targets[0].id: eval(ast.unparse(node.value)) for node in stub.body if isinstance(node, ast.Assign)},
                             wanted, f"_core.pyi beside {name}")
            self.assertEqual(len(stub.body), len(wanted))
            self.assertEqual(type(enum(1)), enum)

    def test_every_key_of_a_frame(self):
        with self.assertRaises(ValueError) as caught:
            swivel.Crowd(1).solve(streams={"?": 0})
        self.assertEqual(str(caught.exception).partition("there are ")[2].split(", "),
                         ["origin", *[name.lower() for name in header_enum("swivel_field")]])

    def test_every_function_of_the_header_has_its_like(self):
        """What Python has under another name, or does by itself."""
        others = {"crowd_create", "crowd_destroy", "crowd_bytes", "workspace_bytes", "last_error", "status_text", "forward",
                  "unpack_rotation", "unpack_half", "field_row_count", "field_first_row", "group_first_limb", "group_limb_count",
                  "group_features", "group_kind", "input_rows", "result_rows", "describe_field", "describe_feature", "describe_constant", "flag_name", "isa_at", "isa_runs", "region_mirror",
                  "state_bytes", "reset_body"}
        functions = {name.removeprefix("swivel_") for name in described("functions")}
        self.assertGreater(len(functions), 40)
        has = set(dir(swivel)) | set(dir(swivel.Crowd)) | {f"region_{name}" for name in dir(swivel.Region)}
        self.assertEqual(functions - has, others)

    def test_every_member_of_bodies_structures(self):
        for name, has, others in (("swivel_skeleton", swivel.Skeleton, {"joint_count"}),
                                  ("swivel_limb_joints", swivel.BodyGroup, {"twist_bone_count"}),
                                  ("swivel_limb_def", swivel.Group, set()), ("swivel_body_limb_def", swivel.BodyGroup, {"joints"}),
                                  ("swivel_plant", swivel.Plant, set()), ("swivel_shift_def", swivel.ShiftGroup, set()),
                                  ("swivel_ground", swivel.Ground, set()), ("swivel_prop_def", swivel.PropGroup, set()),
                                  ("swivel_look_def", swivel.LookGroup, {"joint_count"}),
                                  ("swivel_supports", swivel.Support, set()),
                                  ("swivel_pose", swivel.Pose, {"form", "root_is_double", "results", "translation_results"})):
            members = set(described("structures")[name]["members"]) - {"size", "reserved"}
            self.assertEqual(members - set(has._fields), others, f"swivel.{has.__name__} beside {name}")

    def test_constants_start_as_in_the_header(self):
        for name, has in (("swivel_plant", swivel.Plant()), ("swivel_shift_def", swivel.ShiftGroup()), ("swivel_ground", swivel.Ground()),
                          ("swivel_prop_def", swivel.PropGroup())):
            wanted = [member["default"] for member in described("structures")[name]["members"].values() if "default" in member]
            self.assertEqual(json.loads(json.dumps(has)), wanted, name)

    def test_types_of_members_are_found(self):
        for has in (swivel.Plant, swivel.Ground, swivel.ShiftGroup, swivel.PropGroup, swivel.LookGroup, swivel.Group, swivel.BodyGroup, swivel.Skeleton,
                    swivel.Pose, swivel.Support):
            types = typing.get_type_hints(has)
            self.assertEqual(list(types), list(has._fields), has.__name__)
            self.assertFalse([name for name, each in types.items() if isinstance(each, (str, typing.ForwardRef))], has.__name__)
        self.assertEqual(typing.get_type_hints(swivel.LookGroup)["joints"], typing.Sequence[int])

    def test_every_result_of_arms_has_a_place_in_arms(self):
        results = [field for field in Field if field >= Field.SHOULDER]
        of_arms = {field.name.lower(): swivel.needed_features(field) for field in results if Kind.LIMB in swivel.field_kinds(field)}
        self.assertEqual(set(of_arms), {field.name.lower() for field in results} & set(swivel.Arms._fields))
        self.assertEqual(set(swivel.Arms._field_defaults), {name for name, needed in of_arms.items() if needed})

    def test_needed_features_bring_the_field_and_none_is_too_many(self):
        for field in Field:
            needed = swivel.needed_features(field)
            crowd, group = crowd_with(field, needed)
            self.assertGreater(crowd.component_count(field, group), 0)
            for one in needed:
                try:
                    crowd, group = crowd_with(field, needed & ~one)
                except ValueError:
                    continue  # what is left does not go together
                self.assertEqual(crowd.component_count(field, group), 0)


class Stub(unittest.TestCase):
    def test_all_of_the_module_and_nothing_else(self):
        core = sys.modules["swivel._core"]
        names = {node.name for node in STUB.body if public(node)} | {"LANES"}
        self.assertEqual(names, {name for name in vars(core) if name[0] != "_"})
        self.assertEqual(names | {"BodyGroup", "Group", "Pose", "Skeleton", "Support", "solve"}, set(swivel.__all__))
        for node in STUB.body:
            if isinstance(node, ast.ClassDef) and not issubclass(getattr(swivel, node.name), (int, tuple)):
                wanted = {name for name in vars(getattr(swivel, node.name)) if name[0] != "_"}
                self.assertEqual({each.name for each in node.body if public(each) and each.name[0] != "_"}, wanted, node.name)

    def check_signature(self, stub, runtime):
        line = runtime.__doc__.splitlines()[0]
        self.assertEqual(parameters(stub), parameters(ast.parse(f"def {line}: ...").body[0]), line)

    def test_parameters_and_defaults(self):
        count = 0
        for node in STUB.body:
            if isinstance(node, ast.FunctionDef):
                self.check_signature(node, getattr(swivel, node.name))
            for each in node.body if isinstance(node, ast.ClassDef) else ():
                if isinstance(each, ast.FunctionDef) and not is_property(each):
                    self.check_signature(each, getattr(getattr(swivel, node.name), each.name))
                    count += 1
        self.assertGreater(count, 19)
        tuples = [node for node in STUB.body if isinstance(node, ast.ClassDef) and issubclass(getattr(swivel, node.name), tuple)]
        self.assertEqual([node.name for node in tuples], ["Arms", "Plant", "Ground", "ShiftGroup", "PropGroup", "LookGroup"])
        for node in tuples:
            has = getattr(swivel, node.name)
            self.assertEqual([each.target.id for each in node.body], list(has._fields))
            self.assertEqual({each.target.id: ast.literal_eval(each.value) for each in node.body if each.value}, has._field_defaults)

    def test_types_of_package_and_documentation(self):
        """mypy finds nothing, and does find a mistake."""
        with tempfile.TemporaryDirectory() as folder:
            program, wrong = Path(folder) / "program.py", Path(folder) / "wrong.py"
            program.write_text("\n".join(re.findall(PROGRAM, DOCS, re.DOTALL)), encoding="utf-8")
            wrong.write_text("import swivel\nswivel.Crowd(3).reed(swivel.Field.TARGET)\n", encoding="utf-8")
            base = [sys.executable, "-m", "mypy", "--strict", "--ignore-missing-imports", f"--cache-dir={folder}/cache"]
            environment = {"MYPYPATH": str(PACKAGE.parent), "PATH": "/usr/bin:/bin"}
            run = lambda *files: subprocess.run([*base, *map(str, files)], capture_output=True, text=True, env=environment,
                                                cwd=folder)
            good = run(*PACKAGE.glob("*.py*"), program)
            self.assertEqual(good.returncode, 0, good.stdout + good.stderr)
            self.assertIn('has no attribute "reed"', run(wrong).stdout)


class Words(unittest.TestCase):
    def explained(self, name, thing):
        text = inspect.getdoc(thing) or ""
        if text.startswith(f"{name.rpartition('.')[2]}("):
            text = text.partition("\n\n")[2]
        self.assertGreater(len(text), 12, f"{name} does not say what it is")
        return text

    def test_everything_public_explains_itself(self):
        for name in swivel.__all__:
            thing = getattr(swivel, name)
            if name != "LANES":
                self.explained(name, thing)
            if inspect.isclass(thing) and not issubclass(thing, (int, tuple)):
                for member, value in vars(thing).items():
                    if member[0] != "_":
                        self.explained(f"{name}.{member}", value)

    def test_arrays_tell_their_shapes(self):
        for node in STUB.body:
            for each in (node.body if isinstance(node, ast.ClassDef) else [node]):
                returns = ast.unparse(each.returns) if isinstance(each, ast.FunctionDef) and each.returns else ""
                if re.search("_Floats|_Doubles|NDArray", returns):
                    owner = getattr(swivel, node.name)
                    thing = owner if each is node else getattr(owner, each.name)
                    self.assertRegex(self.explained(each.name, thing), r"\([\w ,+*]*\)", f"{each.name} gives no shape")

    def test_arrays_have_the_numbers_of_their_fields(self):
        """Every field is a row of docs/fields.md, with how many numbers its values have; docs/python.md tells shapes by these."""
        rows = re.findall(r"^\| `(\w+)`(?: \*)? \| (\d+)(?: n|; [^|]*)? \|", FIELDS, re.MULTILINE)
        self.assertEqual([name for name, _ in rows], [field.name for field in Field])
        for field, (_, numbers) in zip(Field, rows):
            crowd, group = crowd_with(field, swivel.needed_features(field))
            self.assertEqual(int(numbers), crowd.component_count(field, group), field.name)
            self.assertEqual(np.ndim(crowd.read(field, group)), 1 if int(numbers) == 1 else 2)


def names_of_programs():
    """The variables that the page's programs leave, run one after the other, and what they print."""
    programs = re.findall(PROGRAM, DOCS, re.DOTALL)
    names, printed = {}, io.StringIO()
    with contextlib.redirect_stdout(printed):
        for program in programs:
            exec(program, names)
    assert len(programs) == 3, f"python.md has {len(programs)} programs"
    return names, printed.getvalue()


class Documentation(unittest.TestCase):
    def test_programs_run(self):
        names, printed = names_of_programs()
        self.assertIn("['REACHED', 'CLAMPED_FAR']", printed)
        np.testing.assert_allclose(names["plain"].wrist_position[0], names["targets"][0], atol=1e-6)
        np.testing.assert_allclose(np.linalg.norm(names["upper_arms"], axis=1), 1, atol=1e-6)
        self.assertIsNotNone(names["limited"].wrist)
        for crowd in ("crowd", "limbs"):
            self.assertFalse(np.any(flags_of(names[crowd]) & Flag.BAD_INPUT))
        np.testing.assert_allclose(names["limbs"].wrists(1)[:100], (names["hips"] - (0, 0.8, 0))[:100], atol=1e-4)
        self.assertTrue(np.all(names["limbs"].elbows(1)[:100, 2] > 0.1))  # forwards
        np.testing.assert_allclose(names["arm"].lengths, (0.30, 0.26), rtol=1e-6)
        for what in ("planted", "held", "seen"):  # by the flags of all bodies
            self.assertTrue(np.all(names[what]), what)
        np.testing.assert_allclose(names["rifles"][:, :3], names["drawn_at"] + (0, 1.3, 0.35), atol=1e-4)


if __name__ == "__main__":
    unittest.main()
