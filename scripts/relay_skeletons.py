#!/usr/bin/python3
"""Turns keypoints of other packages into posefusion/Skeletons on `skeletons_in`.

Subscribes `keypoints`, whatever of these its type is:
  ros_openpose/Frame   persons with bodyParts of score and pixel; its header must be the image's
  std_msgs/String      OpenPose's JSON with one more key, the stamp of the image:
                       {"stamp": "1305031102.175304", "people": [{"pose_keypoints_2d": [...]}]}

    rosrun posefusion relay_skeletons.py keypoints:=/frame

SkeletonIngest (source: topic) checks what comes out. Messages that cannot be turned are left out,
with a line in the log.
"""

import json

LAYOUTS = {18: "coco18", 25: "body25"}


def layout_of(people):
    """Name of the layout by the number of joints; of nobody coco18. Raises ValueError."""
    counts = {len(joints) for joints in people} or {18}
    if len(counts) > 1 or not counts <= set(LAYOUTS):
        raise ValueError("people with %s joints; 18 or 25 are known" % sorted(counts))
    return LAYOUTS[counts.pop()]


def people_of_frame(frame):
    """Joints (u, v, p) of each person of a ros_openpose/Frame."""
    return [
        [(part.pixel.x, part.pixel.y, part.score) for part in person.bodyParts]
        for person in frame.persons
    ]


def people_of_json(text):
    """Seconds, nanoseconds of the stamp, and joints (u, v, p) of each person. Raises ValueError."""
    try:
        data = json.loads(text)
        seconds, _, decimals = str(data["stamp"]).partition(".")
        stamp = int(seconds), int(decimals[:9].ljust(9, "0"))
        people = []
        for person in data["people"]:
            numbers = [float(number) for number in person["pose_keypoints_2d"]]
            if len(numbers) % 3 != 0:
                raise ValueError("%d numbers for a person" % len(numbers))
            people.append(list(zip(numbers[0::3], numbers[1::3], numbers[2::3])))
    except (KeyError, TypeError, AttributeError) as error:
        raise ValueError("no JSON with stamp and people: %r" % error) from error
    return stamp, people


def make_message(header, people):
    """posefusion/Skeletons."""
    from posefusion.msg import Joint, Skeleton, Skeletons

    message = Skeletons(header=header, layout=layout_of(people))
    for joints in people:
        message.people.append(Skeleton(joints=[Joint(u=u, v=v, p=p) for u, v, p in joints]))
    return message


def convert(message):
    """A message of one of the known types as posefusion/Skeletons. Raises ValueError."""
    import rospy
    from std_msgs.msg import Header

    if hasattr(message, "persons"):
        return make_message(message.header, people_of_frame(message))
    if message._type == "std_msgs/String":
        stamp, people = people_of_json(message.data)
        return make_message(Header(stamp=rospy.Time(*stamp)), people)
    raise ValueError("type %s is not known" % message._type)


def main():
    """Waits for the topic and relays it."""
    import rospy
    import rostopic
    from posefusion.msg import Skeletons

    rospy.init_node("relay_skeletons")
    topic = rospy.resolve_name("keypoints")
    message_class, _, _ = rostopic.get_topic_class(topic, blocking=True)
    if message_class is None:
        raise SystemExit("relay_skeletons: %s: its message type is not installed" % topic)
    publisher = rospy.Publisher("skeletons_in", Skeletons, queue_size=10)

    def relay(message):
        try:
            publisher.publish(convert(message))
        except ValueError as error:
            rospy.logerr_throttle(5, "%s: %s" % (topic, error))

    rospy.Subscriber(topic, message_class, relay, queue_size=10)
    rospy.loginfo("relaying %s of type %s", topic, message_class._type)
    rospy.spin()


if __name__ == "__main__":
    main()
