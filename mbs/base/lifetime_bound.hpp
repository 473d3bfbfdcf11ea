/// @file
/// A parameter that what is made of it refers to: clang warns where it dies first.
#pragma once

#ifdef __clang__
#define CARDAN_LIFETIME_BOUND [[clang::lifetimebound]]
#else
#define CARDAN_LIFETIME_BOUND
#endif
