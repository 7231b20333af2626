#!/usr/bin/python3
"""Arrows between folders point down, and the picture of doc/architecture.md shows them."""

import os
import sys
import unittest

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))

import layers  # noqa: E402

PICTURE = "doc/pictures/architecture.png"


class LayersTest(unittest.TestCase):
    def test_every_folder_has_a_place(self):
        known = set(layers.BELOW) | {f"core/{room}" for room in layers.CORE} | {f"ros/{room}" for room in layers.ROS}
        self.assertEqual({layers.room_of(path) for path in layers.source_files()} - known, set())

    def test_arrows_point_down(self):
        wrong = [f"{i.path}:{i.line}: {layers.room_of(i.path)} must not include {i.included}" for i in layers.includes()
                 if not layers.may_include(layers.room_of(i.path), layers.room_of(i.included))]
        self.assertEqual(wrong, [], "\n" + "\n".join(wrong))

    def test_public_headers_include_no_private_ones(self):
        wrong = [f"{i.path}:{i.line}: {i.included} is not installed" for i in layers.includes()
                 if i.path.startswith("include/") and not i.included.startswith("include/")]
        self.assertEqual(wrong, [], "\n" + "\n".join(wrong))

    def test_the_picture_is_of_these_arrows(self):
        with open(os.path.join(layers.ROOT, PICTURE), "rb") as file:
            drawn = layers.fingerprint().encode() in file.read()
        self.assertTrue(drawn, "the picture is of other arrows: scripts/architecture draws it again")


if __name__ == "__main__":
    unittest.main()
