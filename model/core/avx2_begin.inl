// The functions from here to avx2_end.inl may use AVX2, without fused multiplication. Both are included by .cpp files
// for x86-64 alone.
#ifdef __clang__
#pragma clang attribute push(__attribute__((target("avx2"))), apply_to = function)
#else
#pragma GCC push_options
#pragma GCC target("avx2")
#endif
