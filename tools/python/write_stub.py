# SPDX-License-Identifier: MIT
"""Writes the extension module's stub: the template, with the enums and the named tuples that the built module has.

    write_stub.py MODULE TEMPLATE STUB
"""
import importlib.util
import sys
from pathlib import Path


def enum_text(enum):
    # Names alone, `A: int`, would be attributes of each member to a type checker.
    members = "".join(f"    {name} = {int(member)}\n" for name, member in enum.__members__.items())
    return f"class {enum.__name__}(enum.{enum.__bases__[0].__name__}):\n{members}"


def arms_text(module):
    def type_of(name):
        return "npt.NDArray[np.uint32]" if name == "flags" else "_Floats" if name.upper() in module.Field.__members__ else "_Doubles"
    arms = module.Arms
    members = "".join(f"    {name}: Optional[{type_of(name)}] = None\n" if name in arms._field_defaults else f"    {name}: {type_of(name)}\n"
                      for name in arms._fields)
    return f"class Arms(NamedTuple):\n{members}"


def constants_text(constants):
    defaults = {name: f" = {value}" for name, value in constants._field_defaults.items()}
    members = "".join(f"    {name}: {kind}{defaults.get(name, '')}\n" for name, kind in constants.__annotations__.items())
    return f"class {constants.__name__}(NamedTuple):\n{members}"


def main(module_path, template, stub):
    spec = importlib.util.spec_from_file_location("_core", module_path)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    classes = [each for each in vars(module).values() if isinstance(each, type)]
    enums = [enum_text(each) for each in classes if issubclass(each, int)]
    constants = [constants_text(each) for each in classes if issubclass(each, tuple) and each is not module.Arms]
    text = template.read_text(encoding="utf-8").replace("@ENUMS@\n", "\n".join([*enums, arms_text(module), *constants]) + "\n")
    stub.unlink(missing_ok=True)  # a link, where the stub was a source
    stub.write_text(text, encoding="utf-8")


if __name__ == "__main__":
    main(*map(Path, sys.argv[1:]))
