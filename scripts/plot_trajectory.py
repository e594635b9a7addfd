#!/usr/bin/python3
"""Plots what evaluate_trajectory wrote into a folder: trajectory, axes, ATE and RPE over time."""

import csv
import json
import os
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402
import numpy as np  # noqa: E402
from matplotlib.collections import LineCollection  # noqa: E402

MAX_GAP_S = 0.5  # lines are broken where poses are missing for longer
MAX_ERROR_BARS = 300
TRUTH_STYLE = {"color": "black", "linewidth": 1.2, "label": "truth"}
ESTIMATE_STYLE = {"color": "tab:blue", "linewidth": 1.2, "label": "estimate"}


def read_table(path):
    """Columns of a CSV file as arrays by name."""
    with open(path, newline="", encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    names = rows[0].keys() if rows else []
    return {name: np.array([float(row[name]) for row in rows]) for name in names}


def broken_at_gaps(time_s, *series):
    """The series with NaN where time jumps, so that lines do not bridge gaps."""
    gaps = np.flatnonzero(np.diff(time_s) > MAX_GAP_S) + 1
    return [np.insert(values, gaps, np.nan) for values in (time_s, *series)]


def save(figure, folder, name):
    figure.savefig(os.path.join(folder, name), dpi=110, bbox_inches="tight")
    plt.close(figure)


def plot_top_view(poses, summary, folder):
    figure, axes = plt.subplots(figsize=(7, 6))
    truth = np.column_stack([poses["truth_x_m"], poses["truth_y_m"]])
    estimate = np.column_stack([poses["estimate_x_m"], poses["estimate_y_m"]])
    step = max(1, len(truth) // MAX_ERROR_BARS)
    bars = np.stack([truth[::step], estimate[::step]], axis=1)
    axes.add_collection(LineCollection(bars, colors="tab:red", linewidths=0.7, label="error"))
    for points, style in ((truth, TRUTH_STYLE), (estimate, ESTIMATE_STYLE)):
        _, x, y = broken_at_gaps(poses["stamp_s"], points[:, 0], points[:, 1])
        axes.plot(x, y, **style)
    axes.plot(*truth[0], "o", color="black", markersize=5, label="start")
    axes.set_aspect("equal", adjustable="datalim")
    axes.set(xlabel="x [m]", ylabel="y [m]")
    axes.set_title(f"Seen from above, ATE {summary['ate']['translation']['rmse_m']:.4f} m RMS")
    axes.grid(alpha=0.3)
    axes.legend()
    save(figure, folder, "trajectory_top.png")


def plot_axes(poses, time_s, folder):
    figure, rows = plt.subplots(3, 1, figsize=(9, 7), sharex=True)
    for axis, axes in zip("xyz", rows):
        for source, style in (("truth", TRUTH_STYLE), ("estimate", ESTIMATE_STYLE)):
            axes.plot(*broken_at_gaps(time_s, poses[f"{source}_{axis}_m"]), **style)
        axes.set_ylabel(f"{axis} [m]")
        axes.grid(alpha=0.3)
    rows[0].legend(loc="upper right")
    rows[-1].set_xlabel("time [s]")
    rows[0].set_title("Camera position, estimate aligned to the truth")
    save(figure, folder, "trajectory_axes.png")


def plot_errors(time_s, panels, title, name, folder):
    """Error curves over time; panels are (values, label, rmse)."""
    figure, rows = plt.subplots(len(panels), 1, figsize=(9, 5), sharex=True)
    for axes, (values, label, rmse) in zip(rows, panels):
        axes.plot(*broken_at_gaps(time_s, values), color="tab:red", linewidth=1)
        axes.axhline(rmse, color="black", linestyle="--", linewidth=1, label=f"RMS {rmse:.4f}")
        axes.set_ylabel(label)
        axes.set_ylim(bottom=0)
        axes.grid(alpha=0.3)
        axes.legend(loc="upper right")
    rows[-1].set_xlabel("time [s]")
    rows[0].set_title(title)
    save(figure, folder, name)


def main():
    if len(sys.argv) != 2:
        sys.exit("usage: plot_trajectory.py FOLDER")
    folder = sys.argv[1]
    with open(os.path.join(folder, "evaluation.json"), encoding="utf-8") as file:
        summary = json.load(file)
    poses = read_table(os.path.join(folder, "evaluation_poses.csv"))
    start_s = poses["stamp_s"][0]
    time_s = poses["stamp_s"] - start_s
    plot_top_view(poses, summary, folder)
    plot_axes(poses, time_s, folder)
    ate = summary["ate"]
    panels = [
        (poses["translation_error_m"], "translation [m]", ate["translation"]["rmse_m"]),
        (poses["rotation_error_deg"], "rotation [deg]", ate["rotation"]["rmse_deg"]),
    ]
    plot_errors(time_s, panels, "Absolute trajectory error", "ate.png", folder)
    samples = read_table(os.path.join(folder, "evaluation_rpe.csv"))
    if not samples:
        return  # a run of less than a second has no RPE
    rpe = summary["rpe"]
    panels = [
        (samples["translation_mps"], "translation [m/s]", rpe["translation"]["rmse_mps"]),
        (samples["rotation_degps"], "rotation [deg/s]", rpe["rotation"]["rmse_degps"]),
    ]
    title = "Relative pose error over one second, by its begin"
    plot_errors(samples["begin_s"] - start_s, panels, title, "rpe.png", folder)


if __name__ == "__main__":
    main()
