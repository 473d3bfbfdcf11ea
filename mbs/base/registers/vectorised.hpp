/// @file
/// Use of the processor's vector instructions by the kernels without changing a flag of the build.
#pragma once

/// A function that is compiled twice, for any processor and for those with AVX2 (GCC: and FMA, which clang 14 cannot
/// ask for beside it); the right version is chosen when the program starts. Everything it calls must be CARDAN_INLINE
/// or a loop of its own. Only pointers and plain numbers may be passed in and out, so that no type depends on the
/// processor. The versions are chosen before a sanitizer is initialised, so sanitizer builds use the vector types
/// without them.
#if defined(__GNUC__) && defined(__x86_64__) && defined(__gnu_linux__)
#define CARDAN_HAS_VECTOR_TYPES
#endif
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define CARDAN_SANITIZED
#elif defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer) || __has_feature(memory_sanitizer)
#define CARDAN_SANITIZED
#endif
#endif
#if defined(CARDAN_HAS_VECTOR_TYPES) && !defined(CARDAN_SANITIZED)
#define CARDAN_HAS_CLONES
#if defined(__clang__)
#define CARDAN_VECTORISED __attribute__((target_clones("avx2", "default")))
#else
#define CARDAN_VECTORISED __attribute__((target_clones("arch=x86-64-v3", "default")))
#endif
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
