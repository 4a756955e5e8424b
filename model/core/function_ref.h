// A reference to a function, like std::function_ref of C++26: it owns nothing and allocates nothing.
#pragma once

#include <memory>
#include <type_traits>

namespace contort {

template <class Signature>
class FunctionRef;

// The function must outlive the reference: pass a named lambda, or one that is created in the call itself.
template <class Result, class... Arguments>
class FunctionRef<Result(Arguments...)> {
 public:
  template <class Callable>
    requires(!std::is_same_v<std::remove_cvref_t<Callable>, FunctionRef>)
  FunctionRef(const Callable& callable)
      : callable_(std::addressof(callable)), call_([](const void* target, Arguments... arguments) -> Result {
          return (*static_cast<const Callable*>(target))(arguments...);
        }) {}

  Result operator()(Arguments... arguments) const { return call_(callable_, arguments...); }

 private:
  const void* callable_;
  Result (*call_)(const void*, Arguments...);
};

}  // namespace contort
