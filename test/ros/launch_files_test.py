#!/usr/bin/python3
"""Launch files: arguments are documented, the README lists them, camera.launch fits its driver."""

import os
import re
import subprocess
import tempfile
import unittest
import xml.etree.ElementTree as ElementTree

PACKAGE = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
NAMES = ("slam", "bag", "demo", "robot", "camera")
# openni2_launch is no Debian package; these are the arguments of its openni2.launch that matter.
DRIVER_ARGUMENTS = ("camera", "device_id", "depth_registration", "color_depth_synchronization",
                    "publish_tf")


def path_of(name):
    return os.path.join(PACKAGE, "launch", name + ".launch")


def arguments_of(name):
    """Arguments of a launch file that can be given, by name."""
    root = ElementTree.parse(path_of(name)).getroot()
    return {arg.get("name"): arg for arg in root.findall("arg") if arg.get("value") is None}


def readme_table():
    """Launch files in which the README lists an argument, by argument."""
    with open(os.path.join(PACKAGE, "README.md")) as readme:
        lines = readme.read().split("\n")
    start = next(i for i, line in enumerate(lines) if line.startswith("| argument | default |"))
    columns = [cell.strip() for cell in lines[start].strip("|").split("|")]
    files = {}
    for line in lines[start + 2:]:
        if not line.startswith("|"):
            break
        cells = [cell.strip() for cell in line.strip("|").split("|")]
        marked = {column for column, cell in zip(columns, cells) if cell == "x"}
        for argument in re.findall(r"`(\w+)`", cells[0]):
            files[argument] = marked
    return files


def make_driver_package(folder):
    package = os.path.join(folder, "openni2_launch")
    os.makedirs(os.path.join(package, "launch"))
    with open(os.path.join(package, "package.xml"), "w") as manifest:
        manifest.write("<package><name>openni2_launch</name><version>1.0.0</version>"
                       "<description>stub</description><license>none</license>"
                       "<maintainer email='a@b.c'>nobody</maintainer></package>")
    with open(os.path.join(package, "launch", "openni2.launch"), "w") as launch:
        args = "".join("<arg name='%s' default=''/><param name='%s' value='$(arg %s)'/>" % (a, a, a)
                       for a in DRIVER_ARGUMENTS)
        launch.write("<launch>%s</launch>" % args)


class LaunchFiles(unittest.TestCase):
    def test_every_argument_is_documented(self):
        for name in NAMES:
            for argument, element in arguments_of(name).items():
                self.assertTrue(element.get("doc"), "%s.launch: %s" % (name, argument))

    def test_the_readme_lists_the_arguments_of_each_file(self):
        table = readme_table()
        for name in NAMES:
            if name == "camera":
                continue
            listed = {argument for argument, files in table.items() if name in files}
            self.assertEqual(listed, set(arguments_of(name)), name + ".launch")

    def test_the_readme_names_the_arguments_of_the_camera(self):
        with open(os.path.join(PACKAGE, "README.md")) as readme:
            line = next(line for line in readme if "`camera.launch` starts" in line)
        self.assertTrue(set(arguments_of("camera")) <= set(re.findall(r"`(\w+)`", line)), line)

    def test_camera_launch_asks_the_driver_for_registered_and_synchronised_depth(self):
        with tempfile.TemporaryDirectory() as folder:
            make_driver_package(folder)
            environment = dict(os.environ)
            environment["ROS_PACKAGE_PATH"] = folder + ":" + environment["ROS_PACKAGE_PATH"]
            parameters = subprocess.run(
                ["roslaunch", "--dump-params", path_of("camera"), "camera:=head"],
                env=environment, check=True, stdout=subprocess.PIPE, universal_newlines=True).stdout
        for expected in ("/depth_registration: true", "/color_depth_synchronization: true",
                         "/camera: head", "/publish_tf: false"):
            self.assertIn(expected, parameters)


if __name__ == "__main__":
    unittest.main()
