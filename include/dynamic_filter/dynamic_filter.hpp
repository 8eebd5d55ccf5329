// SPDX-License-Identifier: MIT
/// Includes the whole library for users: the pipeline, its configuration and its types.
#pragma once

#include "dynamic_filter/config.hpp"
#include "dynamic_filter/error.hpp"
#include "dynamic_filter/odometry/odometry.hpp"
#include "dynamic_filter/parallel.hpp"
#include "dynamic_filter/pipeline/dynamic_filter.hpp"
#include "dynamic_filter/pipeline/online_filter.hpp"
#include "dynamic_filter/types.hpp"
