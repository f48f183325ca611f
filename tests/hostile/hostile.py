# SPDX-License-Identifier: MIT
"""What the tests of hostile input share: values that nobody expects, and a run of a program with its time and memory measured."""
import os
import re
import shutil
import subprocess
import sys
import tempfile
import threading
from pathlib import Path

SWIVEL = Path(os.environ["SWIVEL"])
SECONDS = 60  # a command that takes longer hangs
TOKEN = re.compile(r'"(?:[^"\\]|\\.)*"|[][{}:,]|[^][{}:,\s"]+')  # of JSON
EVIL = ("0", "1", "15", "17", "-1", "65536", "1073741824", "2147483648", "4294967296", "9223372036854775808", "1e+30", "1.5", "null", '"x"', "[]", "{}",
        "[[[[[[[[[[[[]]]]]]]]]]]]", "[" * 100_000)


def argument(name, otherwise):
    """A whole number of the command line."""
    return int(sys.argv[sys.argv.index(name) + 1]) if name in sys.argv else otherwise


def command_with_page(folder):
    """A copy of the command with a page's program beside it, which need not work."""
    for part in ("bin", "share/swivel"):
        (folder / part).mkdir(parents=True)
    (folder / "share/swivel/view.html").write_text('<script data-digest="">start(/*crowd*/null)</script>')
    return shutil.copy(SWIVEL, folder / "bin/swivel")


def measured(program, words, folder):
    """The exit code, what was said on stdout and on stderr, and the most memory that was resident, in MiB."""
    with tempfile.TemporaryFile() as out, tempfile.TemporaryFile() as complaint:
        process = subprocess.Popen([program, *words], cwd=folder, stdin=subprocess.DEVNULL, stdout=out, stderr=complaint)
        timer = threading.Timer(SECONDS, process.kill)
        timer.start()
        _, status, used = os.wait4(process.pid, 0)
        timer.cancel()
        process.returncode = os.waitstatus_to_exitcode(status)
        out.seek(0)
        complaint.seek(0)
        return process.returncode, out.read(), complaint.read(), used.ru_maxrss / 1024
