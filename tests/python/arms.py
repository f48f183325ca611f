# SPDX-License-Identifier: MIT
"""Arms for the tests, and quaternions: NumPy in double, sharing nothing with the library."""
import numpy as np


def times(a, b):
    """Hamilton's product of quaternions x, y, z, w: b first, then a."""
    a, b = np.asarray(a, float), np.asarray(b, float)
    av, aw, bv, bw = a[..., :3], a[..., 3:], b[..., :3], b[..., 3:]
    return np.concatenate([aw * bv + bw * av + np.cross(av, bv), aw * bw - np.sum(av * bv, axis=-1, keepdims=True)], axis=-1)


def rotate(q, v):
    """v turned by the quaternions q."""
    q, v = np.asarray(q, float), np.asarray(v, float)
    q = q / np.linalg.norm(q, axis=-1, keepdims=True)
    u, w = q[..., :3], q[..., 3:]
    return v + 2 * np.cross(u, np.cross(u, v) + w * v)


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
