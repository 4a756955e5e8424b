// CONTORT_ASSERT reports mistakes of our own code, one of three kinds of errors. Bad input is an Issue (result.h); a
// fault in the animation is a Finding (checks). Asserts are active in every build preset except `release`, which does
// not evaluate the expression.
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
