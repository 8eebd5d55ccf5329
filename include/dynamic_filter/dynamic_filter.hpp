// SPDX-License-Identifier: MIT
/// Includes the whole library for users: the pipeline, its configuration and its types.
#pragma once

#include "dynamic_filter/error.hpp"
#include "dynamic_filter/filter.hpp"
#include "dynamic_filter/online.hpp"
#include "dynamic_filter/parallel.hpp"
#include "dynamic_filter/settings.hpp"
#include "dynamic_filter/tracking.hpp"
#include "dynamic_filter/types.hpp"
