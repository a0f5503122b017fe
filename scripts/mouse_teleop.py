#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Teleoperation with the mouse: drag in the window to drive, release to stop. Twist on cmd_vel.

Parameters: ~speed (m/s) and ~turn (rad/s) at the window's edges, ~dead_zone (fraction of the way), ~rate (Hz),
~stamped, ~frame_id.
"""

import signal

signal.signal(signal.SIGINT, signal.SIG_DFL)  # Ctrl-C while modules are loaded shows no traceback

import argparse
import sys
import tkinter

import rospy

from bubblesim.controllers.base_velocity import STANDING, BaseVelocity
from bubblesim.nodes.run_node import run_ros_program
from bubblesim.nodes.twist_commands import TwistCommands
from bubblesim.teleop.stick_teleop import StickTeleop

HALF = 150  # pixels from the window's middle to its edge
KNOB = 12  # pixels


class Window:
    """A knob that follows the mouse while a button is down."""

    def __init__(self, root: tkinter.Tk, teleop: StickTeleop, commands: TwistCommands, period: int) -> None:
        """Draw the window; `period` in ms."""
        self._root = root
        self._teleop = teleop
        self._commands = commands
        self._period = period
        self._velocity = STANDING
        root.title("mouse_teleop")
        root.resizable(False, False)
        self._canvas = tkinter.Canvas(root, width=2 * HALF, height=2 * HALF, background="white")
        self._canvas.pack()
        self._text = tkinter.Label(root, text="drag to drive, release to stop", font="TkFixedFont")
        self._text.pack()
        self._canvas.create_line(HALF, 0, HALF, 2 * HALF, fill="grey")
        self._canvas.create_line(0, HALF, 2 * HALF, HALF, fill="grey")
        self._knob = self._canvas.create_oval(0, 0, 2 * KNOB, 2 * KNOB, fill="steel blue")
        self._move_knob(HALF, HALF)
        for event in ("<ButtonPress-1>", "<B1-Motion>"):
            self._canvas.bind(event, self._on_drag)
        self._canvas.bind("<ButtonRelease-1>", self._on_release)
        self._tick()

    def _on_drag(self, event: "tkinter.Event[tkinter.Canvas]") -> None:
        self._move_knob(event.x, event.y)
        self._drive(self._teleop.velocity(forward=(HALF - event.y) / HALF, left=(HALF - event.x) / HALF))

    def _on_release(self, event: "tkinter.Event[tkinter.Canvas]") -> None:
        self._move_knob(HALF, HALF)
        self._drive(STANDING)

    def _drive(self, velocity: BaseVelocity) -> None:
        self._velocity = velocity
        self._commands.follow(velocity)
        self._text.configure(text=f"{velocity.forward:+.2f} m/s  {velocity.turning:+.2f} rad/s")

    def _move_knob(self, x: int, y: int) -> None:
        x, y = (min(max(place, 0), 2 * HALF) for place in (x, y))
        self._canvas.coords(self._knob, x - KNOB, y - KNOB, x + KNOB, y + KNOB)

    def _tick(self) -> None:
        """Repeat the last command, for robots with a timeout; close the window when the node ends."""
        if rospy.is_shutdown():
            self._root.destroy()
            return
        self._commands.follow(self._velocity)
        self._root.after(self._period, self._tick)


def main() -> int:
    """Run the node until its window is closed; return 2 without a display or for invalid parameters."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.parse_args(rospy.myargv(sys.argv)[1:])
    try:
        root = tkinter.Tk()
    except tkinter.TclError as error:
        print(f"error: cannot open a window: {error}", file=sys.stderr)
        return 2
    rospy.init_node("mouse_teleop")
    try:
        teleop = StickTeleop(
            speed=float(rospy.get_param("~speed", 0.5)),
            turn=float(rospy.get_param("~turn", 1.0)),
            dead_zone=float(rospy.get_param("~dead_zone", 0.1)),
        )
        period = round(1000 / float(rospy.get_param("~rate", 10.0)))
    except (TypeError, ValueError, ZeroDivisionError) as error:
        rospy.logfatal(f"invalid parameter of {rospy.get_name()}: {error}")
        return 2
    Window(root, teleop, TwistCommands(), max(period, 1))
    root.mainloop()
    rospy.signal_shutdown("the window was closed")
    return 0


if __name__ == "__main__":
    sys.exit(run_ros_program(main))
