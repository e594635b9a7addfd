#pragma once

#include "posefusion/dataset/triangle_mesh.h"
