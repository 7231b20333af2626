#!/usr/bin/python3
"""Drives a rover by the keyboard: publishes cmd_vel_in (another topic: cmd_vel_in:=TOPIC), ten times a second.

  w, arrow up       forward, as long as the key is held    + faster
  s, arrow down     back                                   - slower
  a, arrow left     turn left                              space  stop
  d, arrow right    turn right                             q      end
"""

import os
import select
import sys
import termios
import time
import tty

import rospy
from geometry_msgs.msg import Twist

RATE_HZ = 10.0
# A held key repeats after half a second; until then it counts as held.
HELD_S = 0.6
SPEEDS_MPS = (0.2, 0.4, 0.6, 0.8)
TURN_RADPS = 0.3
MOTIONS = {"w": (1, 0), "\x1b[A": (1, 0), "s": (-1, 0), "\x1b[B": (-1, 0),
           "a": (0, 1), "\x1b[D": (0, 1), "d": (0, -1), "\x1b[C": (0, -1)}


class Keyboard:
    """Key presses, from a terminal that otherwise waits for a whole line."""

    def __enter__(self):
        self.settings = termios.tcgetattr(sys.stdin)
        tty.setcbreak(sys.stdin.fileno())
        return self

    def __exit__(self, *_):
        termios.tcsetattr(sys.stdin, termios.TCSADRAIN, self.settings)

    @staticmethod
    def key(wait_s):
        """The newest key, "" for none within the time. Arrows come as three characters."""
        if not select.select([sys.stdin], [], [], wait_s)[0]:
            return ""
        keys = os.read(sys.stdin.fileno(), 64).decode(errors="ignore")
        return keys[-3:] if keys[-3:-1] == "\x1b[" else keys[-1:]


class Driver:
    """Converts keys to a motion that ends when they are released."""

    def __init__(self):
        self.speed = 1
        self.motion = (0, 0)
        self.pressed_s = 0.0

    def press(self, key, now_s):
        if key in MOTIONS:
            self.motion, self.pressed_s = MOTIONS[key], now_s
        elif key == " ":
            self.motion = (0, 0)
        elif key in "+-":
            self.speed = min(max(self.speed + (1 if key == "+" else -1), 0), len(SPEEDS_MPS) - 1)

    def command(self, now_s):
        if now_s - self.pressed_s > HELD_S:
            self.motion = (0, 0)
        twist = Twist()
        twist.linear.x = self.motion[0] * SPEEDS_MPS[self.speed]
        twist.angular.z = self.motion[1] * TURN_RADPS
        return twist


def main():
    if not sys.stdin.isatty():
        sys.exit("keyboard_drive.py: a terminal is needed")
    rospy.init_node("keyboard_drive", anonymous=True)
    publisher = rospy.Publisher("cmd_vel_in", Twist, queue_size=1)
    print(__doc__)
    driver = Driver()
    with Keyboard() as keyboard:
        while not rospy.is_shutdown():
            key = keyboard.key(1.0 / RATE_HZ)
            if key == "q":
                break
            if key:
                driver.press(key, time.monotonic())
            publisher.publish(driver.command(time.monotonic()))
    publisher.publish(Twist())


if __name__ == "__main__":
    main()
