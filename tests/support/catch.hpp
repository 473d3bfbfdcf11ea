/// @file
/// Catch2, version 2 or 3, with Approx in scope in either.
#pragma once

#if __has_include(<catch2/catch_all.hpp>)
#include <catch2/catch_all.hpp>
#define CARDAN_CATCH_VERSION 3
using Catch::Approx;
#else
// No try block in every assertion: tests compile faster, and an exception that none expects still fails its test case.
#define CATCH_CONFIG_FAST_COMPILE
#include <catch2/catch.hpp>
#define CARDAN_CATCH_VERSION 2
#endif
