# SPDX-License-Identifier: MIT
"""Arms for the tests, and quaternions."""
import numpy as np


def quaternions(random, n):
    q = random.normal(size=(n, 4))
    return (q / np.linalg.norm(q, axis=1, keepdims=True)).astype(np.float32)


class Sample:
    """n arms within reach: targets, poles, lengths as float32."""

    def __init__(self, n, seed=1):
        random = np.random.default_rng(seed)
        self.lengths = random.uniform(0.2, 0.4, size=(n, 2)).astype(np.float32)
        far, near = self.lengths.sum(axis=1), abs(self.lengths[:, 0] - self.lengths[:, 1])
        way = random.normal(size=(n, 3))
        way /= np.linalg.norm(way, axis=1, keepdims=True)
        self.targets = (way * (near + random.uniform(0.1, 0.95, n) * (far - near))[:, None]).astype(np.float32)
        self.poles = random.normal(size=(n, 3)).astype(np.float32)
