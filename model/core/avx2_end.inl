// Ends what avx2_begin.inl began.
#ifdef __clang__
#pragma clang attribute pop
#else
#pragma GCC pop_options
#endif
