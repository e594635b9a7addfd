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
BACKGROUND = np.array([62, 68, 78], dtype=np.float32)
PATH_COLOUR = np.array([255, 190, 40], dtype=np.float32)
PATH_DOTS = 20000
NEAR_M = 0.2
RAISE, ASIDE = 0.2, 0.3  # of the eye, in shares of its way back from the map
OUTER_PERCENTILE = 1  # surfels that may lie outside the picture, on each side
MIN_SHARE_BEFORE = 0.9  # of what is shown, before the camera
FILL = 0.96  # share of the picture that map and path take up
MAX_ZOOM = 1.1  # in one of so many steps
VIEW_STEPS = 40
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

    def bounds(self, points, outer_percentile):
        """Left upper and right lower corner [px] of the points without so many outermost ones on
        each side; None when too many lie behind."""
        u, v, z = self.project(points)
        if np.mean(z > 0) < MIN_SHARE_BEFORE:
            return None
        return np.percentile(np.stack([u, v])[:, z > 0], [outer_percentile, 100 - outer_percentile],
                             axis=1)


def viewing_axis(points, normals, trajectory):
    """Unit vector from the map's middle to where it was seen from, and that distance."""
    middle = np.median(points, axis=0)
    if trajectory is not None:
        positions, forward = trajectory
        offset = np.mean(positions, axis=0) - middle
        return unit(unit(offset) - np.mean(forward, axis=0)), np.linalg.norm(offset)
    back = unit(np.mean(normals, axis=0) * [1, 1, 0] + [1e-6, 0, 0])
    return back, np.percentile(np.linalg.norm(points - middle, axis=1), 90)


def choose_view(points, normals, trajectory, width, height):
    """From a little above and beside where the map was seen from; map and path in the picture."""
    back, distance = viewing_axis(points, normals, trajectory)
    back = unit(back + RAISE * UP + ASIDE * unit(np.cross(UP, back)))
    target = np.median(points, axis=0)
    half = np.array([width, height]) / 2
    for _ in range(VIEW_STEPS):
        view = View(target + distance * back, target, width, height)
        bounds = [view.bounds(points, OUTER_PERCENTILE)]
        if trajectory is not None:
            bounds.append(view.bounds(trajectory[0], 0))
        if any(corner is None for corner in bounds):
            distance *= MAX_ZOOM
            continue
        low, high = np.min(bounds, axis=(0, 1)), np.max(bounds, axis=(0, 1))
        shift = ((low + high) / 2 - half) * distance / view.focal
        target = target + shift[0] * view.rotation[0] + shift[1] * view.rotation[1]
        filled = np.max((high - low) / 2 / half) / FILL
        distance *= np.clip(filled, 1 / MAX_ZOOM, MAX_ZOOM)
    return View(target + distance * back, target, width, height)


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


def view_of(vertices, trajectory, width, height):
    """The view that shows a map and its path well."""
    points = columns(vertices, "x", "y", "z")
    normals = columns(vertices, "nx", "ny", "nz")
    return choose_view(points, normals, trajectory, width * SUPERSAMPLING, height * SUPERSAMPLING)


def render(vertices, trajectory, view, width, height):
    """RGB picture of the map."""
    points = columns(vertices, "x", "y", "z")
    normals = columns(vertices, "nx", "ny", "nz")
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
    parser.add_argument("--view-of", metavar="MAP", help="another map: the view that shows it best")
    parser.add_argument("--width", type=int, default=1280)
    parser.add_argument("--height", type=int, default=800)
    arguments = parser.parse_args()
    try:
        trajectory = read_trajectory(arguments.trajectory) if arguments.trajectory else None
        size = arguments.width, arguments.height
        vertices = read_ply(arguments.map)
        view = view_of(read_ply(arguments.view_of or arguments.map), trajectory, *size)
        picture = render(vertices, trajectory, view, *size)
        matplotlib.image.imsave(arguments.picture, picture)
    except (OSError, ValueError, KeyError) as error:
        print(f"render_map: {error}", file=sys.stderr)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
