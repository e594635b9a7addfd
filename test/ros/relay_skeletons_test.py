#!/usr/bin/python3
"""What scripts/relay_skeletons.py makes of other packages' messages."""

import os
import sys
import unittest
from types import SimpleNamespace

sys.path.insert(0, os.path.join(os.path.dirname(__file__), "..", "..", "scripts"))
sys.dont_write_bytecode = True

import relay_skeletons  # noqa: E402
from std_msgs.msg import Header, String  # noqa: E402


def person(num_joints):
    part = SimpleNamespace(score=0.5, pixel=SimpleNamespace(x=3.0, y=4.0))
    return SimpleNamespace(bodyParts=[part] * num_joints)


class RelaySkeletons(unittest.TestCase):
    def test_frame_keeps_header_and_joints(self):
        header = Header(frame_id="camera")
        frame = SimpleNamespace(header=header, persons=[person(25), person(25)])
        message = relay_skeletons.convert(frame)
        self.assertEqual(message.header, header)
        self.assertEqual(message.layout, "body25")
        self.assertEqual(len(message.people), 2)
        joint = message.people[1].joints[24]
        self.assertEqual((joint.u, joint.v, joint.p), (3, 4, 0.5))

    def test_json_keeps_every_digit_of_the_stamp(self):
        numbers = ", ".join(["1", "2", "0.5"] * 18)
        text = '{"stamp": "1305031102.175304", "people": [{"pose_keypoints_2d": [%s]}]}' % numbers
        message = relay_skeletons.convert(String(data=text))
        self.assertEqual(message.header.stamp.to_nsec(), 1305031102175304000)
        self.assertEqual(message.layout, "coco18")
        self.assertEqual(len(message.people[0].joints), 18)

    def test_nobody_is_a_message_without_people(self):
        message = relay_skeletons.convert(String(data='{"stamp": "5", "people": []}'))
        self.assertEqual(message.people, [])
        self.assertEqual(message.header.stamp.to_nsec(), 5000000000)

    def test_bad_messages_are_refused_with_one_kind_of_error(self):
        bad = ["", "[]", "3", "{}", '{"people": []}', '{"stamp": "x", "people": []}',
               '{"stamp": "5", "people": [1]}',
               '{"stamp": "5", "people": [{"pose_keypoints_2d": [1, 2]}]}',
               '{"stamp": "5", "people": [{"pose_keypoints_2d": [1, 2, 3]}]}']
        for text in bad:
            with self.assertRaises(ValueError, msg=text):
                relay_skeletons.convert(String(data=text))
        with self.assertRaises(ValueError):
            relay_skeletons.convert(SimpleNamespace(header=Header(), persons=[person(17)]))
        with self.assertRaises(ValueError):
            relay_skeletons.convert(Header())


if __name__ == "__main__":
    unittest.main()
