# Fails when a file under CORE includes a header of ROS or a generated message.
set(forbidden
  "#include *[<\"](ros|roscpp|rosbag|tf|tf2|tf2_ros|nodelet|pluginlib|cv_bridge|message_filters"
  "|image_transport|[a-z0-9_]+_msgs|posefusion_ros|boost|XmlRpc[A-Za-z]*)[/.]"
  "|#include *[<\"]posefusion/[A-Z]")
string(CONCAT forbidden ${forbidden})
file(GLOB_RECURSE sources ${CORE}/*.h ${CORE}/*.cpp)
if(NOT sources)
  message(FATAL_ERROR "${CORE}: no sources")
endif()
set(found FALSE)
foreach(source ${sources})
  file(STRINGS ${source} lines REGEX "${forbidden}")
  foreach(line ${lines})
    message("${source}: ${line}")
    set(found TRUE)
  endforeach()
endforeach()
if(found)
  message(FATAL_ERROR "the core includes ROS headers")
endif()
