#!/usr/bin/python3
"""Renders map.ply as a picture: every surfel a disc, seen from behind the camera that mapped it."""

import argparse
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.image  # noqa: E402
import numpy as np  # noqa: E402

PLY_TYPES = {
    "char": "i1", "uchar": "u1", "short": "<i2", "ushort": "<u2", "int": "<i4", "uint": "<u4",
    "float": "<f4", "double": "<f8", "int8": "i1", "uint8": "u1", "int16": "<i2", "uint16": "<u2",
    "int32": "<i4", "uint32": "<u4", "float32": "<f4", "float64": "<f8"}
UP = np.array([0.0, 0.0, 1.0])
BACKGROUND = np.array([24, 26, 31], dtype=np.float32)
PATH_COLOUR = np.array([255, 190, 40], dtype=np.float32)
PATH_DOTS = 20000
NEAR_M = 0.2
SHARE_IN_PICTURE = 0.9
MAX_STEPS_BACK = 30
MAX_DISC_PX = 12
SUPERSAMPLING = 2


def read_ply(path):
    """Vertices of a binary little-endian PLY as a structured array."""
    with open(path, "rb") as file:
        if file.readline().strip() != b"ply":
            raise ValueError(f"{path}: no PLY file")
        fields, count, in_vertex = [], 0, False
        for line in iter(file.readline, b""):
            words = line.decode("ascii").split()
            if words[:1] == ["format"] and words[1] != "binary_little_endian":
                raise ValueError(f"{path}: format {words[1]} instead of binary_little_endian")
            if words[:1] == ["element"]:
                in_vertex = words[1] == "vertex"
                count = int(words[2]) if in_vertex else count
            if words[:1] == ["property"] and in_vertex:
                fields.append((words[2], PLY_TYPES[words[1]]))
            if words == ["end_header"]:
                break
        vertices = np.fromfile(file, dtype=fields, count=count)
    if count == 0 or len(vertices) < count:
        raise ValueError(f"{path}: {len(vertices)} of {count} surfels")
    return vertices


def columns(vertices, *names):
    """The named properties as columns of a float array."""
    return np.stack([vertices[name].astype(np.float64) for name in names], axis=1)


def read_trajectory(path):
    """Positions (N x 3) and viewing directions (N x 3) of a TUM trajectory file."""
    rows = np.loadtxt(path, ndmin=2)
    x, y, z, w = rows[:, 4:8].T
    forward = np.stack([2 * (x * z + w * y), 2 * (y * z - w * x), 1 - 2 * (x * x + y * y)], axis=1)
    return rows[:, 1:4], forward


def unit(vector):
    """The vector with length one."""
    return vector / np.linalg.norm(vector)


class View:
    """A pinhole camera that looks from `eye` to `target`, z of the map up."""

    def __init__(self, eye, target, width, height, fov_deg=60.0):
        forward = unit(target - eye)
        right = unit(np.cross(forward, UP))
        self.rotation = np.stack([right, np.cross(forward, right), forward])
        self.eye = eye
        self.width, self.height = width, height
        self.focal = 0.5 * width / np.tan(np.radians(fov_deg) / 2)

    def project(self, points):
        """Pixels u, v and depths of points; whatever is behind gets depth 0."""
        p = (points - self.eye) @ self.rotation.T
        z = np.where(p[:, 2] > NEAR_M, p[:, 2], 0)
        safe = np.where(z > 0, z, 1)
        u = self.focal * p[:, 0] / safe + self.width / 2
        v = self.focal * p[:, 1] / safe + self.height / 2
        return u, v, z

    def share_inside(self, points):
        """Share of the points that fall into the picture."""
        u, v, z = self.project(points)
        return np.mean((z > 0) & (u >= 0) & (u < self.width) & (v >= 0) & (v < self.height))


def choose_view(points, normals, trajectory, width, height):
    """Behind and above where the map was seen from, looking at its middle."""
    target = np.median(points, axis=0)
    if trajectory is not None:
        positions, forward = trajectory
        eye = np.mean(positions, axis=0)
        back = -unit(np.mean(forward, axis=0))
    else:
        back = unit(np.mean(normals, axis=0) * [1, 1, 0] + [1e-6, 0, 0])
        eye = target + back * np.percentile(np.linalg.norm(points - target, axis=1), 90)
    back = unit(back * [1, 1, 0] + [1e-9, 0, 0])
    distance = np.linalg.norm(target - eye)
    towards_eye = unit(eye + distance * (0.45 * UP + 0.25 * np.cross(UP, back)) - target)
    for _ in range(MAX_STEPS_BACK):
        view = View(target + distance * towards_eye, target, width, height)
        if view.share_inside(points) > SHARE_IN_PICTURE:
            break
        distance *= 1.1
    return view


def discs(u, v, z, radius_px):
    """Flat lists of the pixels that discs cover: index of the disc, x, y."""
    size = np.clip(np.ceil(radius_px), 1, MAX_DISC_PX).astype(int)
    parts = []
    for radius in np.unique(size):
        of_size = np.flatnonzero((size == radius) & (z > 0))
        reach = np.arange(-radius, radius + 1)
        dx, dy = (grid.ravel() for grid in np.meshgrid(reach, reach))
        inside = dx * dx + dy * dy <= radius * radius
        index = np.repeat(of_size, inside.sum())
        x = np.round(u[index]).astype(int) + np.tile(dx[inside], len(of_size))
        y = np.round(v[index]).astype(int) + np.tile(dy[inside], len(of_size))
        parts.append(np.stack([index, x, y]))
    return np.concatenate(parts, axis=1)


def paint(image, index, x, y, z, colours):
    """Paints pixels of discs, the near ones over the far ones."""
    height, width = image.shape[:2]
    visible = (x >= 0) & (x < width) & (y >= 0) & (y < height)
    index, x, y = index[visible], x[visible], y[visible]
    order = np.argsort(-z[index], kind="stable")
    image[y[order], x[order]] = colours[index[order]]


def paint_path(image, view, positions):
    """Draws the camera's way as a line over everything."""
    steps = np.linspace(0, len(positions) - 1, PATH_DOTS)
    index = np.arange(len(positions))
    dots = np.stack([np.interp(steps, index, axis) for axis in positions.T], axis=1)
    u, v, z = view.project(dots)
    index, x, y = discs(u, v, z, np.full(len(u), SUPERSAMPLING))
    paint(image, index, x, y, z, np.tile(PATH_COLOUR, (len(u), 1)))


def render(vertices, trajectory, width, height):
    """RGB picture of the map."""
    points = columns(vertices, "x", "y", "z")
    normals = columns(vertices, "nx", "ny", "nz")
    view = choose_view(points, normals, trajectory, width * SUPERSAMPLING, height * SUPERSAMPLING)
    facing = np.einsum("ij,ij->i", normals, view.eye - points) > 0
    u, v, z = view.project(points)
    z = np.where(facing, z, 0)
    towards = view.eye - points
    slant = np.abs(np.einsum("ij,ij->i", normals, towards)) / np.linalg.norm(towards, axis=1)
    colours = columns(vertices, "red", "green", "blue") * (0.75 + 0.25 * slant)[:, None]
    radius_px = view.focal * vertices["radius"] / np.where(z > 0, z, 1)
    image = np.tile(BACKGROUND, (view.height, view.width, 1))
    index, x, y = discs(u, v, z, radius_px)
    paint(image, index, x, y, z, colours.astype(np.float32))
    if trajectory is not None:
        paint_path(image, view, trajectory[0])
    blocks = image.reshape(height, SUPERSAMPLING, width, SUPERSAMPLING, 3)
    return np.clip(blocks.mean(axis=(1, 3)), 0, 255).astype(np.uint8)


def main():
    """Command line."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("map", help="map.ply of run_dataset or the Mapping nodelet")
    parser.add_argument("picture", help="the PNG to write")
    parser.add_argument("--trajectory", help="trajectory.txt: sets the view and is drawn")
    parser.add_argument("--width", type=int, default=1280)
    parser.add_argument("--height", type=int, default=800)
    arguments = parser.parse_args()
    try:
        trajectory = read_trajectory(arguments.trajectory) if arguments.trajectory else None
        picture = render(read_ply(arguments.map), trajectory, arguments.width, arguments.height)
        matplotlib.image.imsave(arguments.picture, picture)
    except (OSError, ValueError, KeyError) as error:
        print(f"render_map: {error}", file=sys.stderr)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
