#pragma once

// The messages Joint, Skeleton and Skeletons are generated into namespace posefusion, where the
// core has types of these names. Included from here the messages are called JointMessage,
// SkeletonMessage and SkeletonsMessage; nothing else may include the generated headers.

#include <ros/builtin_message_traits.h>
#include <ros/message_operations.h>
#include <ros/serialization.h>
#include <ros/types.h>
#include <std_msgs/Header.h>

#include <memory>
#include <string>
#include <vector>

#define Joint JointMessage
#define Skeleton SkeletonMessage
#define Skeletons SkeletonsMessage
#include <posefusion/Joint.h>
#include <posefusion/Skeleton.h>
#include <posefusion/Skeletons.h>
#undef Joint
#undef Skeleton
#undef Skeletons
