# SPDX-License-Identifier: MIT
"""What the tests of hostile input share: values that nobody expects, and a run of a program with its time and memory measured."""
import os
import re
import shutil
import subprocess
import sys
import tempfile
import threading
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

SWIVEL = Path(os.environ["SWIVEL"])
SECONDS = 60  # a command that takes longer hangs
TOKEN = re.compile(r'"(?:[^"\\]|\\.)*"|[][{}:,]|[^][{}:,\s"]+')  # of JSON
EVIL = ("0", "1", "15", "17", "-1", "65536", "1073741824", "2147483648", "4294967296", "9223372036854775808", "1e+30", "1.5", "null", '"x"', "[]", "{}",
        "[[[[[[[[[[[[]]]]]]]]]]]]", "[" * 100_000)


def argument(name, otherwise):
    """A whole number of the command line."""
    return int(sys.argv[sys.argv.index(name) + 1]) if name in sys.argv else otherwise


def check_all(test, what, faults_of, count, codes):
    """Tries `count` inputs from --seed on. faults_of: of a seed, as texts. codes: how often each command ended with each exit code, which faults_of
    counts. Some inputs get through each command and some do not, so what is behind the first checks is reached, too."""
    seed = argument("--seed", 0)
    with ThreadPoolExecutor(os.cpu_count()) as pool:
        faults = [fault for of_one in pool.map(faults_of, range(seed, seed + count)) for fault in of_one]
    print(f"{count} {what}; exit codes {dict(sorted(codes.items()))}")
    test.assertEqual(faults, [], "\n" + "\n".join(faults[:20]))
    if count >= 150:
        for command in {command for command, _ in codes}:
            test.assertGreater(min(codes[command, 0], codes[command, 1]), 0, command)


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
