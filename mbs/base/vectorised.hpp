/// @file
/// How the kernels use the vector instructions of the processor without changing a flag of the build.
#pragma once

/// A function that is compiled twice, for any processor and for those with AVX2 and FMA; the right version is chosen
/// when the program starts. Everything it calls must be CARDAN_INLINE or a loop of its own. Only pointers and plain
/// numbers may be passed in and out, so that no type depends on the processor. GCC on x86-64 Linux only: clang 14 has
/// no such clones. The clones are resolved before a sanitizer is initialised, so sanitizer builds use the vector types
/// without them.
#if defined(__GNUC__) && !defined(__clang__) && defined(__x86_64__) && defined(__gnu_linux__)
#define CARDAN_HAS_VECTOR_TYPES
#endif
#if defined(CARDAN_HAS_VECTOR_TYPES) && !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#define CARDAN_HAS_CLONES
#define CARDAN_VECTORISED __attribute__((target_clones("arch=x86-64-v3", "default")))
#else
#define CARDAN_VECTORISED
#endif

/// Always inlined: passing a vector register to a function would make the ABI depend on the processor.
#if defined(__GNUC__)
#define CARDAN_INLINE [[gnu::always_inline]] inline
#define CARDAN_INLINE_LAMBDA __attribute__((always_inline))
#else
#define CARDAN_INLINE inline
#define CARDAN_INLINE_LAMBDA
#endif

/// Place before a loop whose body is little more than a store.
#if defined(__clang__)
#define CARDAN_UNROLL _Pragma("clang loop unroll_count(4)")
#elif defined(__GNUC__)
#define CARDAN_UNROLL _Pragma("GCC unroll 4")
#else
#define CARDAN_UNROLL
#endif
