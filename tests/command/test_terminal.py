# SPDX-License-Identifier: MIT
"""The promise: no text of a file makes a terminal do something. Control characters and what changes the direction of writing become escapes, in
messages, reports and JSON, and what a message quotes of a file is short. Python's tables of Unicode judge."""
import json
import subprocess
import unicodedata

from stage import SWIVEL, Stage, bvh, unittest

DIRECTIONS = {"LRE", "RLE", "LRO", "RLO", "PDF", "LRI", "RLI", "FSI", "PDI"}
MARKS = "\u061c\u200e\u200f"  # of one letter's direction; with the above they are Unicode's Bidi_Control
NO_NAME = "\x00 \t\r\n\v\f{}"  # what ends a word of BVH, or makes the file no text


def is_obeyed(character):
    return unicodedata.category(character) == "Cc" or unicodedata.bidirectional(character) in DIRECTIONS or character in MARKS


def shown(text):
    """What is obeyed, ends of lines aside."""
    return sorted({f"{ord(each):04x}" for each in text if each != "\n" and is_obeyed(each)})


def figure(names):
    """A figure with joints of these names, beside its own."""
    joints = "".join(f"JOINT {name}\n{{\nOFFSET 1 0 0\nEnd Site\n{{\nOFFSET 1 0 0\n}}\n}}\n" for name in names)
    return bvh().replace("JOINT LeftUpLeg", f"{joints}JOINT LeftUpLeg", 1)


class Terminal(Stage):
    def run_with(self, files, *words, code=0):
        for name, content in files.items():
            (self.folder / name).write_bytes(content if isinstance(content, bytes) else content.encode())
        done = subprocess.run([SWIVEL, *words], cwd=self.folder, capture_output=True)
        self.assertEqual(done.returncode, code, done.stderr)
        return done.stdout.decode(errors="surrogateescape"), done.stderr.decode(errors="surrogateescape")

    def refusal(self, files, *words):
        said = self.run_with(files, *words, code=1)[1]
        self.assertEqual((said.count("\n"), shown(said)), (1, []), said)
        return said

    def test_every_character_in_the_names_of_joints(self):
        characters = [chr(code) for code in [*range(0x21, 0x3000), 0xFEFF, 0xE0001, 0xE007F, 0x1F9B4] if chr(code) not in NO_NAME]
        names = ["x" + "".join(characters[at:at + 60]) for at in range(0, len(characters), 60)]
        clip = {"clip.bvh": figure(names)}
        said = self.run_with(clip, "rig", "clip.bvh", "--joints")[0]
        self.assertEqual(shown(said), [])
        for character in characters:
            if not is_obeyed(character):
                self.assertIn(character, said)
        said = self.run_with(clip, "rig", "clip.bvh", "--joints", "--json")[0]
        self.assertEqual(shown(said), [])
        self.assertEqual([joint["name"] for joint in json.loads(said)["joint_list"]][1:len(names) + 1], names)

    def test_messages_escape(self):
        evil = "a\x1b[2J\x9b31m\x85\u202eb\u2066c\u200fd\u061ce"
        escaped = r"a\x1b[2J\u009b31m\u0085\u202eb\u2066c\u200fd\u061ce"
        for files, words in (({"c.bvh": figure(["a"]).replace("OFFSET 1 0 0", f"OFFSET {evil} 0 0", 1)}, ("rig", "c.bvh")),
                             ({"c.bvh": figure(["a"]), "t.csv": f"frame,character,{evil},x,y,z\n"}, ("solve", "c.bvh", "--targets", "t.csv")),
                             ({"c.toml": json.dumps(evil) + " = 1\n"}, ("solve", "c.bvh", "--crowd", "c.toml")),
                             ({"c.gltf": json.dumps({"asset": {"version": evil}}, ensure_ascii=False)}, ("rig", "c.gltf"))):
            with self.subTest(words=words):
                self.assertIn(r"\u009b31m\u0085\u202eb", self.refusal(files, *words))
        self.assertIn(escaped, self.refusal({}, "rig", f"{evil}.bvh"))
        self.assertIn(r"\x9b31m", self.refusal({}, "rig", b"a\x9b31m.bvh"))  # as terminals of one byte a letter obey it
        said = self.run_with({}, evil, code=2)[1]
        self.assertEqual(shown(said), [])

    def test_what_is_quoted_is_short(self):
        long = "z" * 5000
        animations = [{"name": f"walk{n}" + long, "channels": [], "samplers": []} for n in range(300)]
        for files, words in (({"c.bvh": figure(["a"]).replace("OFFSET 1 0 0", f"OFFSET {long} 0 0", 1)}, ("rig", "c.bvh")),
                             ({"c.bvh": f"HIERARCHY {long}"}, ("rig", "c.bvh")),
                             ({"c.bvh": figure(["a"]), "c.toml": f"{long} = 1\n"}, ("solve", "c.bvh", "--crowd", "c.toml")),
                             ({"c.toml": f"[crowd]\nlimbs = \"{long}\"\n"}, ("solve", "c.bvh", "--crowd", "c.toml")),
                             ({"c.gltf": json.dumps({"asset": {"version": "2.0"}, "nodes": [{"name": "a"}], "animations": animations})}, ("rig", "c.gltf", "--clip", "x")),
                             ({"c.gltf": f'{{"asset": "{long}'}, ("rig", "c.gltf"))):
            with self.subTest(words=words):
                said = self.refusal(files, *words)
                self.assertIn("...", said)
                self.assertLess(len(said), 200 + 250, "a quote and what is said of it")


if __name__ == "__main__":
    unittest.main()
