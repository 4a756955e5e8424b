// A file descriptor that is closed when its owner is done with it, and all bytes written through one.
#pragma once

#include <string_view>

namespace contort {

class Descriptor {
 public:
  explicit Descriptor(int number) : number_(number) {}
  ~Descriptor() { close(); }
  Descriptor(Descriptor&& other) noexcept : number_(other.release()) {}
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;

  bool ok() const { return number_ >= 0; }
  int number() const { return number_; }

  // Hands the descriptor over to the caller, who closes it.
  int release();

  // False where the system reports an error of an earlier write only now; errno says which.
  bool close();

 private:
  int number_;
};

// Writes all bytes, however many calls that takes. False where that fails; errno says why.
bool write_all(int descriptor, std::string_view bytes);

}  // namespace contort
