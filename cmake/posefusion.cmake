# Helpers that give every target of ours the same flags.

# What our own code is compiled with. -ffp-contract=off: the same arithmetic with and without FMA
# units, so that every dispatch variant of a kernel gives the same bits.
add_library(posefusion_flags INTERFACE)
target_compile_options(posefusion_flags INTERFACE
  -Wall -Wextra -Wconversion -ffp-contract=off -fno-math-errno -fno-trapping-math -Wno-psabi)
target_include_directories(posefusion_flags INTERFACE ${PROJECT_SOURCE_DIR}/src)

# posefusion_library(NAME SOURCES ... DEPENDS ... [PRIVATE_DEPENDS ...])
# One static library posefusion_NAME per concept folder.
function(posefusion_library name)
  cmake_parse_arguments(ARG "" "" "SOURCES;DEPENDS;PRIVATE_DEPENDS" ${ARGN})
  add_library(posefusion_${name} STATIC ${ARG_SOURCES})
  target_include_directories(posefusion_${name} PUBLIC ${PROJECT_SOURCE_DIR}/src)
  target_link_libraries(posefusion_${name}
    PUBLIC ${ARG_DEPENDS} PRIVATE posefusion_flags ${ARG_PRIVATE_DEPENDS})
endfunction()

# posefusion_tool(NAME [SOURCES ...] DEPENDS ...) - a small main from src/tools/NAME.cpp, run by
# rosrun.
function(posefusion_tool name)
  cmake_parse_arguments(ARG "" "" "SOURCES;DEPENDS" ${ARGN})
  add_executable(${name} ${name}.cpp ${ARG_SOURCES})
  target_link_libraries(${name} PRIVATE posefusion_flags ${ARG_DEPENDS})
  set_target_properties(${name} PROPERTIES
    RUNTIME_OUTPUT_DIRECTORY ${CATKIN_DEVEL_PREFIX}/${CATKIN_PACKAGE_BIN_DESTINATION})
  install(TARGETS ${name} RUNTIME DESTINATION ${CATKIN_PACKAGE_BIN_DESTINATION})
endfunction()

# posefusion_tests(NAME SOURCES ... DEPENDS ... [LABELS ...])
# One executable per folder of test/; ctest lists every TEST in it by its own name.
function(posefusion_tests name)
  cmake_parse_arguments(ARG "" "TIMEOUT" "SOURCES;DEPENDS;LABELS" ${ARGN})
  if(NOT ARG_TIMEOUT)
    set(ARG_TIMEOUT 120)
  endif()
  add_executable(${name}_test ${ARG_SOURCES})
  target_include_directories(${name}_test PRIVATE ${PROJECT_SOURCE_DIR})
  target_link_libraries(${name}_test PRIVATE
    posefusion_flags ${ARG_DEPENDS} GTest::gmock GTest::gtest GTest::gtest_main)
  target_precompile_headers(${name}_test PRIVATE
    <gtest/gtest.h> <Eigen/Geometry> <string> <vector>)
  gtest_discover_tests(${name}_test
    DISCOVERY_TIMEOUT 60
    PROPERTIES TIMEOUT ${ARG_TIMEOUT} ENVIRONMENT RC_PARAMS=seed=42 LABELS "${ARG_LABELS}")
endfunction()

# For programs of ROS run by ctest: our python first, and nothing written outside the build folder.
set(posefusion_ros_environment
  "PATH=/usr/bin:$ENV{PATH}" "ROS_HOME=${CMAKE_BINARY_DIR}/ros_home"
  "ROS_LOG_DIR=${CMAKE_BINARY_DIR}/ros_home/log")

# posefusion_rostest(NAME SOURCES ... DEPENDS ... [TIMEOUT seconds])
# A gtest program with its own main that NAME.test starts beside a ROS master.
function(posefusion_rostest name)
  cmake_parse_arguments(ARG "" "TIMEOUT" "SOURCES;DEPENDS" ${ARGN})
  if(NOT ARG_TIMEOUT)
    set(ARG_TIMEOUT 120)
  endif()
  add_executable(${name}_test ${ARG_SOURCES})
  add_dependencies(${name}_test posefusion_nodelets)
  target_include_directories(${name}_test PRIVATE ${PROJECT_SOURCE_DIR})
  target_link_libraries(${name}_test PRIVATE
    posefusion_flags ${ARG_DEPENDS} GTest::gmock GTest::gtest)
  set_target_properties(${name}_test PROPERTIES
    RUNTIME_OUTPUT_DIRECTORY ${CATKIN_DEVEL_PREFIX}/${CATKIN_PACKAGE_BIN_DESTINATION})
  add_test(NAME ros.${name} COMMAND ${CATKIN_DEVEL_PREFIX}/env.sh
    rostest ${CMAKE_CURRENT_SOURCE_DIR}/${name}.test)
  set_tests_properties(ros.${name} PROPERTIES
    TIMEOUT ${ARG_TIMEOUT} ENVIRONMENT "${posefusion_ros_environment}")
endfunction()
