#!/usr/bin/python3
"""Waits until Mapping has worked on every frame of a bag that is being played, then ends.

As a required node of a launch file it ends the launch. Exits 1 when no frame has come in time.
"""

import sys
import time

import rospy

from posefusion.msg import BlurScore, Status

PERIOD_S = 0.2


class Waiter:
    """Looks at `status` until frames have come and then stopped coming."""

    def __init__(self):
        self.start_timeout_s = rospy.get_param("~start_timeout_s", 60.0)
        self.quiet_s = rospy.get_param("~quiet_s", 4.0)
        self.start = time.monotonic()
        self.last_change = self.start
        self.status = None
        self.blurred = 0
        rospy.Subscriber("status", Status, self.on_status)
        rospy.Subscriber("blur_score", BlurScore, self.on_blur_score)

    def on_status(self, status):
        if self.status is None or status.frames_processed != self.status.frames_processed:
            self.last_change = time.monotonic()
        self.status = status

    def on_blur_score(self, score):
        self.blurred = score.frames_dropped

    def started(self):
        return self.status is not None and self.status.frames_processed > 0

    def finished(self):
        quiet = time.monotonic() - self.last_change > self.quiet_s
        return self.started() and quiet and self.status.queue_length == 0

    def run(self):
        while not rospy.is_shutdown() and not self.finished():
            if not self.started() and time.monotonic() - self.start > self.start_timeout_s:
                print("wait_for_mapping: no frame has come", file=sys.stderr)
                return 1
            time.sleep(PERIOD_S)
        if self.started():
            print("frames: %d left out as blurred, %d processed, %d tracked, %d lost, %d dropped, "
                  "%d evicted, %d refused" % (
                      self.blurred, self.status.frames_processed, self.status.frames_tracked,
                      self.status.frames_lost, self.status.frames_dropped,
                      self.status.frames_evicted, self.status.frames_refused), flush=True)
        return 0


if __name__ == "__main__":
    rospy.init_node("wait_for_mapping")
    sys.exit(Waiter().run())
