// SPDX-License-Identifier: MIT
//
// C++ on top of swivel_bodies.h. swivel.hpp has all of it, because any crowd may be of bodies.
#pragma once

#include "swivel.hpp"
