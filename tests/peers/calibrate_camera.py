#!/usr/bin/env python3
"""armcal and OpenCV's hand-eye calibration on the same images of a board.

  python3 tests/peers/calibrate_camera.py --armcal=build/armcal [--arms=5] [--images=60]

A six-axis arm (data/six_axis/real.yaml) whose axes are half a millimetre and one to
three milliradians off its file, a camera on the flange, a chessboard before it, 0.3 px of
noise; pixels by OpenCV's own projectPoints. OpenCV (4.x of PyPI: opencv-python-headless)
solves for the camera on the flange by calibrateHandEye (Park) with the file's geometry; armcal
fits the frames alone, the joints' zeros, or all of the geometry; the latter also with the lens
estimated from the same images. Printed is the rms of the
camera's position in the board's frame, beside the true one, at postures near those that were
photographed, mm.
"""

import argparse
import json
import subprocess
import sys
import tempfile
from pathlib import Path

import cv2
import numpy as np
import yaml

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))

import result_files  # noqa: E402

ROBOT = Path(__file__).resolve().parents[2] / "data" / "six_axis" / "real.yaml"
FIELDS = (".a", ".d", ".alpha", ".theta", ".beta")
K = np.array([[900, 0, 640], [0, 905, 360], [0, 0, 1.]])
LENS = np.array([-.12, .05, .0008, -.0005, 0])
BOARD = np.array([[.025 * i, .025 * j, 0] for j in range(6) for i in range(9)])
NOISE = .3  # px
REACH = np.array([2.6, 1.6, 2.4, 2.6, 2.6, 2.6])  # rad


def turn(axis, angle):
    vector = np.zeros(3)
    vector["xyz".index(axis)] = angle
    return cv2.Rodrigues(vector)[0]


def rpy(roll, pitch, yaw):
    return turn("z", yaw) @ turn("y", pitch) @ turn("x", roll)


def frame(R=np.eye(3), p=(0, 0, 0)):
    X = np.eye(4)
    X[:3, :3], X[:3, 3] = R, p
    return X


def flange(rows, q):
    X = np.eye(4)
    for (a, d, alpha, theta, beta), angle in zip(rows, q):
        X = (X @ frame(turn("z", angle + theta), (0, 0, 0)) @ frame(p=(a, 0, d))
             @ frame(turn("x", alpha) @ turn("y", beta)))
    return X


class Campaign:
    def __init__(self, seed, images):
        self.random = np.random.default_rng(seed)
        links = yaml.safe_load(ROBOT.read_text())["links"]
        self.names = [link["name"] for link in links]
        self.file = [(link["a"], link["d"], link["alpha"], 0, 0) for link in links]
        size = np.array([5e-4, 5e-4, 1e-3, 3e-3, 1e-3])
        self.true = [tuple(row + size * self.random.normal(size=5)) for row in self.file]
        self.camera = frame(rpy(.1, -.05, .4), (.03, -.05, .08))
        self.board = frame(rpy(.05, .02, .3), (-.55, .1, .05))
        self.q, self.pixels = [], []
        while len(self.q) < images:
            self.photograph()

    def view(self):
        """X_BC of a camera that looks at the board's middle."""
        z = -np.r_[self.random.uniform(-.6, .6, 2), 1]
        z /= np.linalg.norm(z)
        angle = self.random.uniform(0, 2 * np.pi)
        x = np.cross(z, [np.cos(angle), np.sin(angle), .2])
        x /= np.linalg.norm(x)
        middle = BOARD.mean(0) + .02 * self.random.normal(size=3)
        return frame(np.c_[x, np.cross(z, x), z], middle - self.random.uniform(.3, .6) * z)

    def posture(self, target):
        """Where the camera is at the target, by Gauss and Newton; None: nowhere."""
        def error(q):
            X = np.linalg.inv(flange(self.true, q) @ self.camera) @ target
            return np.r_[X[:3, 3], cv2.Rodrigues(X[:3, :3])[0].ravel()]
        q = self.random.uniform(-.8, .8, 6) * REACH
        for _ in range(200):
            e = error(q)
            if np.linalg.norm(e) < 1e-10:
                q = np.arctan2(np.sin(q), np.cos(q))
                return q if np.all(abs(q) < REACH) else None
            J = np.array([(error(q + 1e-6 * unit) - e) / 1e-6 for unit in np.eye(6)]).T
            step = -np.linalg.pinv(J, rcond=1e-2) @ e
            q = q + step * min(1, .5 / np.linalg.norm(step))
        return None

    def photograph(self):
        q = self.posture(self.board @ self.view())
        if q is None:
            return
        X_CB = np.linalg.inv(flange(self.true, q) @ self.camera) @ self.board
        pixels = cv2.projectPoints(BOARD, cv2.Rodrigues(X_CB[:3, :3])[0], X_CB[:3, 3],
                                   K, LENS)[0][:, 0]
        seen = np.all((pixels > 0) & (pixels < (1280, 720)), axis=1)
        if seen.sum() < 20:
            return
        pixels += NOISE * self.random.normal(size=pixels.shape)
        self.q.append(q)
        self.pixels.append((pixels, seen))

    def tool_error(self, rows, base, camera):
        """rms of the camera's position in the board's frame, mm."""
        true_base = np.linalg.inv(self.board)
        squares = []
        for q in self.q:
            near = q + self.random.uniform(-.3, .3, 6)
            found = base @ flange(rows, near) @ camera
            true = true_base @ flange(self.true, near) @ self.camera
            squares.append(np.sum((found - true)[:3, 3] ** 2))
        return 1e3 * np.sqrt(np.mean(squares))

    def opencv(self):
        arms = [flange(self.file, q) for q in self.q]
        boards = []
        for pixels, seen in self.pixels:
            _, r, t = cv2.solvePnP(BOARD[seen], pixels[seen], K, LENS)
            boards.append(frame(cv2.Rodrigues(r)[0], t.ravel()))
        R, t = cv2.calibrateHandEye([X[:3, :3] for X in arms], [X[:3, 3] for X in arms],
                                    [X[:3, :3] for X in boards], [X[:3, 3] for X in boards],
                                    method=cv2.CALIB_HAND_EYE_PARK)
        camera = frame(R, t.ravel())
        # The board is where the images have it in the mean.
        bases = [np.linalg.inv(arm @ camera @ board) for arm, board in zip(arms, boards)]
        U, _, V = np.linalg.svd(sum(X[:3, :3] for X in bases))
        base = frame(U @ V, np.mean([X[:3, 3] for X in bases], 0))
        return self.tool_error(self.file, base, camera)

    def armcal(self, program, geometry, folder, lens=None):
        rows = ["image,q1,q2,q3,q4,q5,q6,bx,by,u,v"]
        for k, (q, (pixels, seen)) in enumerate(zip(self.q, self.pixels)):
            for point, pixel in zip(BOARD[seen], pixels[seen]):
                numbers = [*q, *point[:2], *pixel]
                rows.append(f"{k + 1}," + ",".join(f"{x:.9g}" for x in numbers))
        (folder / "board.csv").write_text("\n".join(rows) + "\n")
        (folder / "camera.yaml").write_text(yaml.safe_dump({
            "image_width": 1280, "image_height": 720, "camera_name": "hand",
            "camera_matrix": {"rows": 3, "cols": 3, "data": K.ravel().tolist()},
            "distortion_model": "plumb_bob",
            "distortion_coefficients": {"rows": 1, "cols": 5, "data": LENS.tolist()}}))
        subprocess.run([program, "calibrate", f"--robot={ROBOT}",
                        f"--poses={folder}/board.csv", f"--camera={lens or folder / 'camera.yaml'}",
                        f"--geometry={geometry}", f"--out={folder}/out"],
                       stdout=subprocess.DEVNULL, check=False)
        found = {p["name"]: p["value"] for p in
                 json.loads((folder / "out/calibration.json").read_text())["geometry"]}

        def pose(name):
            return frame(rpy(*(found[name + f] for f in (".roll", ".pitch", ".yaw"))),
                         [found[name + f] for f in (".x", ".y", ".z")])
        own = [tuple(found.get(name + field, value) for field, value in zip(FIELDS, row))
               for name, row in zip(self.names, self.file)]
        return self.tool_error(own, pose("base"), pose("tool"))


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--armcal", default="build/armcal")
    parser.add_argument("--arms", type=int, default=5)
    parser.add_argument("--images", type=int, default=60)
    result_files.add_flag(parser)
    options = parser.parse_args()
    rows = []
    print("tool error, mm   OpenCV hand-eye   armcal frames    zeros      all   all, lens estimated")
    for seed in range(1, options.arms + 1):
        campaign = Campaign(seed, options.images)
        with tempfile.TemporaryDirectory() as folder:
            ours = [campaign.armcal(options.armcal, geometry, Path(folder))
                    for geometry in ("known", "offsets", "refine")]
            ours.append(campaign.armcal(options.armcal, "refine", Path(folder), "estimate"))
        rows.append([campaign.opencv(), *ours])
        print(f"arm {seed:2d}         {rows[-1][0]:15.3f}  {ours[0]:14.3f}"
              f" {ours[1]:8.3f} {ours[2]:8.3f} {ours[3]:10.3f}", flush=True)
    if options.results:
        names = ("opencv", "known", "offsets", "refine", "lens")
        result_files.write(options.results, "simulated arms, images of a board: tool error, mm",
                           {name: [min(of), max(of)] for name, of in zip(names, zip(*rows))} |
                           {"ratio": [1, min(r[0] / r[3] for r in rows),
                                      1, max(r[0] / r[3] for r in rows)]})


if __name__ == "__main__":
    main()
