#!/usr/bin/python3
"""The routes of doc/architecture.md are those of the code, and short."""

import os
import sys
import unittest

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))

import routes  # noqa: E402

MOST_FILES = {"from an IMU sample to odometry": 15, "from slip to cmd_vel": 12,
              "from a key in YAML to the line that uses it": 8}


class RoutesTest(unittest.TestCase):
    def test_each_step_is_called_by_another(self):
        for title, steps in routes.routes().items():
            self.assertEqual(routes.flaws(steps), [], title)

    def test_they_are_short(self):
        self.assertEqual({title: min(len(routes.files(steps)), MOST_FILES[title])
                          for title, steps in routes.routes().items()},
                         {title: len(routes.files(steps)) for title, steps in routes.routes().items()})
        self.assertEqual(set(routes.routes()), set(MOST_FILES))

    def test_every_file_but_those_of_launch_has_a_function(self):
        empty = [step.file for steps in routes.routes().values() for step in steps
                 if not step.functions and not step.file.startswith("launch/")]
        self.assertEqual(empty, [])

    def test_a_gap_is_found(self):
        """Without any of these steps, nothing calls the next one."""
        for title, left_out in (("from an IMU sample to odometry", "src/core/navigation/mechanizer.cpp"),
                                ("from an IMU sample to odometry", "src/nodelets/filter_nodelet.cpp"),
                                ("from slip to cmd_vel", "src/core/forecast/forecaster.cpp"),
                                ("from slip to cmd_vel", "src/nodelets/stop_supervisor_nodelet.cpp"),
                                ("from a key in YAML to the line that uses it", "src/config/yaml_reader.h")):
            steps = [step for step in routes.routes()[title] if step.file != left_out]
            self.assertNotEqual(routes.flaws(steps), [], left_out)

    def test_a_function_that_is_elsewhere_is_found(self):
        step = routes.Step("src/core/ins/strapdown.cpp", [("InsEngine", "step")])
        self.assertEqual(routes.flaws([step]), ["src/core/ins/strapdown.cpp does not define InsEngine::step"])


if __name__ == "__main__":
    unittest.main()
