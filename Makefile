# The common tasks. Each one installs missing Debian packages (packages.txt) and builds first.

BUILD_DIR ?= build
JOBS ?= $(shell nproc)

# Another python first in PATH would break catkin, pluginlib and message generation.
export PATH := /usr/bin:$(PATH)
export DEBIAN_FRONTEND := noninteractive
PYTHON_FLAGS := -DPYTHON_EXECUTABLE=/usr/bin/python3 -DPython3_EXECUTABLE=/usr/bin/python3

.PHONY: build demo test test-long clean

build:
	scripts/install_packages.sh
	cmake -S . -B $(BUILD_DIR) -DCMAKE_BUILD_TYPE=Release $(PYTHON_FLAGS)
	cmake --build $(BUILD_DIR) --parallel $(JOBS)

demo: build
	scripts/demo.sh $(BUILD_DIR)

test: build
	cd $(BUILD_DIR) && ctest --output-on-failure --label-exclude long

test-long: build
	cd $(BUILD_DIR) && ctest --output-on-failure --label-regex long

clean:
	rm -rf $(BUILD_DIR)
