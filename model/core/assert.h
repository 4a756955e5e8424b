// CONTORT_ASSERT is for mistakes of our own code, one of three kinds of errors. Bad input is an Issue (result.h); a
// fault in the animation is a Finding (checks). Asserts are active in every build preset except `release`, in which
// the expression is not evaluated.
#pragma once

#ifdef CONTORT_ASSERTS
namespace contort {
[[noreturn]] void assertion_failed(const char* expression, const char* file, int line);
}
#define CONTORT_ASSERT(expression) \
  ((expression) ? static_cast<void>(0) : ::contort::assertion_failed(#expression, __FILE__, __LINE__))
#else
#define CONTORT_ASSERT(expression) static_cast<void>(0)
#endif
