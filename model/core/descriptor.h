// A file descriptor that is closed when its owner is destroyed, and a function that writes all bytes to one.
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

  // Returns false if the system reports an error of an earlier write only now; errno has the reason.
  bool close();

 private:
  int number_;
};

// Writes all bytes, with as many calls as needed. Returns false if that fails; errno has the reason.
bool write_all(int descriptor, std::string_view bytes);

}  // namespace contort
