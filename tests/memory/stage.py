# SPDX-License-Identifier: MIT
"""Small inputs for every subcommand, and runs of the command while it lacks memory.

SWIVEL names the command, NO_MEMORY the library of no_memory.c, WORK a folder for a copy of the command."""
import os
import shutil
import subprocess
import tempfile
from pathlib import Path

NO_MEMORY, WORK = os.environ["NO_MEMORY"], Path(os.environ["WORK"])
PLACE = "/dev/shm" if os.access("/dev/shm", os.W_OK) else None  # outputs are synced, and memory does not wait for that
NAMES = ("Arm", "ForeArm", "Hand")
FRAMES = ("1 2 3 0 10 0 0 20 0 0 -30 0 5 0 0 0 20 0 0 30 0 5 0 0", "1 2 4 0 11 0 0 21 0 0 -31 0 6 0 0 0 21 0 0 31 0 6 0 0")


def command_with_page():
    """A copy of the command with a page's program beside it, which need not work."""
    for folder in ("bin", "share/swivel"):
        (WORK / folder).mkdir(parents=True, exist_ok=True)
    (WORK / "share/swivel/view.html").write_text("<script data-digest=\"\">start(/*crowd*/null)</script>\n")
    return shutil.copy(os.environ["SWIVEL"], WORK / "bin/swivel")


def bvh():
    three = "CHANNELS 3 Zrotation Yrotation Xrotation\n"
    limb = lambda side, sign: "".join(f"JOINT {side}{name}\n{{\nOFFSET {sign}{at}\n{three}" for name, at in zip(NAMES, ("2 5 0", "5 0 0", "3 0 0"))) + f"End Site\n{{\nOFFSET {sign}1 0 0\n}}\n}}\n}}\n}}\n"
    return ("HIERARCHY\nROOT Hips\n{\nOFFSET 0 0 0\nCHANNELS 6 Xposition Yposition Zposition Zrotation Yrotation Xrotation\n"
            + limb("Left", "") + limb("Right", "-") + "}\nMOTION\nFrames: 2\nFrame Time: .01\n" + "\n".join(FRAMES) + "\n")


def make_inputs(folder, command):
    folder.mkdir()
    (folder / "clip.bvh").write_text(bvh())
    (folder / "table.csv").write_text("frame,character,limb,x,y,z\n0,0,left_arm,6,8,3\n1,0,right_arm,-6,8,3\n")
    (folder / "crowd.toml").write_text("[limb.arms]\nlimits.flexion_deg = [5, 150]\nswivel.most_deg_per_frame = 4\n")
    for words in (("store", "clip.bvh", "empty"), ("store", "clip.bvh", "full"), ("fill", "full")):
        subprocess.run([command, *words, "--quiet"], cwd=folder, check=True)


def files_of(folder):
    return {str(path.relative_to(folder)): path.read_bytes() for path in folder.rglob("*") if path.is_file()}


class Run:
    """A command line, run in a copy of the inputs, and what came of it."""

    def __init__(self, command, inputs, words, lacks=None):
        with tempfile.TemporaryDirectory(dir=PLACE) as made:
            folder, count = Path(made) / "f", Path(made) / "requests"
            shutil.copytree(inputs, folder)
            environment = os.environ | {"LD_PRELOAD": NO_MEMORY, "SWIVEL_REQUESTS": str(count)} | ({"SWIVEL_LACKS": lacks} if lacks else {})
            done = subprocess.run([command, *words], cwd=folder, env=environment, stdin=subprocess.DEVNULL, capture_output=True, timeout=120)
            self.code, self.out, self.err = done.returncode, done.stdout, done.stderr.decode(errors="backslashreplace")
            self.requests = int(count.read_text()) if count.exists() and count.read_text() else None
            self.files = files_of(folder)
            self.folders = {str(path.relative_to(folder)) for path in folder.rglob("*") if path.is_dir()}
