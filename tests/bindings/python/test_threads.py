# SPDX-License-Identifier: MIT
"""The promise: long calls let other Python threads run, blocks may be solved by several threads, and a crowd that is in use by
another thread is refused instead of raced for."""
import sys
import threading
import time
import unittest

import numpy as np

import swivel
from figures import Bodies, Sample, crowd_of
from swivel import Field

N = 200000


class Threads(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.sample = Sample(N)
        cls.crowd = swivel.Crowd(N)
        cls.crowd.write(Field.TARGET, cls.sample.targets)
        cls.crowd.write(Field.POLE, cls.sample.poles)
        cls.crowd.write(Field.LENGTHS, cls.sample.lengths)

    def lets_others_run(self, call):
        """With a switch interval of an hour another thread runs only while this one has given the GIL away of its own will. It
        waits for `go`, so it starts within call() or, were the GIL never given away, not before the loop has ended."""
        before = sys.getswitchinterval()
        go, ran = threading.Lock(), []
        go.acquire()

        def other():
            with go:
                ran.append(True)

        thread = threading.Thread(target=other)
        thread.start()
        sys.setswitchinterval(3600)
        try:
            go.release()
            end = time.monotonic() + 20
            while not ran and time.monotonic() < end:
                call()
            return bool(ran)
        finally:
            sys.setswitchinterval(before)
            thread.join()

    def test_long_calls_release_the_gil(self):
        crowd, ones = self.crowd, np.ones(N, np.float32)
        active = np.ones(self.crowd.lane_count, bool)
        out, target = np.zeros((N, 4), np.float32), self.sample.targets
        place = np.zeros((N, 3))
        blocks = (0, crowd.block_count)
        bodies, pose = crowd_of(20000, swivel.Feature.POLE_INCOMING), swivel.Pose(Bodies(20000).rotations)
        for call in (crowd.solve, lambda: crowd.solve(blocks=blocks, on_this_thread=True), lambda: crowd.solve(mask=active),
                     lambda: crowd.choose([ones], 1000), crowd.reset,
                     lambda: crowd.solve(streams={"target": target, "shoulder": out}),
                     lambda: crowd.solve(streams={"target": target}, blocks=blocks, on_this_thread=True),
                     lambda: bodies.solve(pose=pose), lambda: bodies.solve(pose=pose, blocks=(0, 900), on_this_thread=True),
                     lambda: crowd.write(Field.TARGET, target), lambda: crowd.write_doubles(Field.TARGET, place),
                     lambda: crowd.read(Field.SHOULDER, out=out), lambda: crowd.wrists(out=place),
                     lambda: crowd.residuals(), lambda: crowd.joint_angles(), lambda: swivel.verify(2000)):
            self.assertTrue(self.lets_others_run(call))

    def test_blocks_on_several_threads(self):
        alone, together = swivel.Crowd(N), swivel.Crowd(N)
        for crowd in (alone, together):
            crowd.write(Field.TARGET, self.sample.targets)
            crowd.write(Field.LENGTHS, self.sample.lengths)
        alone.solve(blocks=(0, alone.block_count), on_this_thread=True)
        share = -(-together.block_count // 4)
        threads = [threading.Thread(target=together.solve, kwargs={"blocks": (first, min(share, together.block_count - first)), "on_this_thread": True})
                   for first in range(0, together.block_count, share)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        np.testing.assert_array_equal(together.rows(Field.SHOULDER), alone.rows(Field.SHOULDER))

    def test_a_crowd_in_use_is_refused(self):
        """One thread solves over and over, this one reads: both end well or with RuntimeError, and refusals do happen."""
        refused = []
        stop = threading.Event()

        def read():
            while not stop.is_set():
                try:
                    self.crowd.read(Field.SHOULDER)
                except RuntimeError as error:
                    refused.append(str(error))

        thread = threading.Thread(target=read)
        thread.start()
        end = time.monotonic() + 20
        while not refused and time.monotonic() < end:
            try:
                self.crowd.solve()
            except RuntimeError as error:
                refused.append(str(error))
        stop.set()
        thread.join()
        self.assertIn("another thread is using this crowd", refused[0])
        self.crowd.solve()  # and it is free again


if __name__ == "__main__":
    unittest.main()
