// Lets Contort test an animation generator in C++. This header needs C++17 and nothing else; it works on machines with
// little-endian numbers. Give `serve` a manifest as JSON text (docs/reference/guests.md has all its fields) and a
// function that fills the poses of a motion:
//
//   int main() {
//     return contort_guest::serve(kManifest, [](const contort_guest::Request& request, contort_guest::Motion& motion) {
//       for (int frame = 0; frame < motion.frames(); ++frame) motion.turn(frame, 1, {1, 0, 0}, 30.0);
//     });
//   }
//
// Throw contort_guest::Refused for a request that the generator cannot serve. Other exceptions are findings.
#pragma once

#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <iostream>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#ifdef _WIN32
#include <fcntl.h>
#include <io.h>
#else
#include <unistd.h>
#endif

namespace contort_guest {

using Vec3 = std::array<double, 3>;
using Quat = std::array<double, 4>;  // x, y, z, w

struct Refused : std::runtime_error {
  using std::runtime_error::runtime_error;
};

// A JSON value. `true` is the number 1 and `false` 0. Missing fields read as an empty value.
struct Json {
  double number = 0.0;
  std::string text;
  std::vector<Json> items;
  std::vector<std::pair<std::string, Json>> fields;

  const Json& operator[](const std::string& name) const {
    static const Json none;
    for (const auto& [key, value] : fields)
      if (key == name) return value;
    return none;
  }
  Vec3 vec3() const { return {items.at(0).number, items.at(1).number, items.at(2).number}; }
};

// Reads the JSON that Contort writes and that manifests have; escapes other than \uXXXX of ASCII stay as they are.
class JsonReader {
 public:
  explicit JsonReader(const std::string& text) : at_(text.c_str()) {}

  Json read() {
    Json out;
    const char first = skip();
    if (first == '{') {
      list('}', [&] {
        std::string name = string();
        expect(':');
        out.fields.emplace_back(std::move(name), read());
      });
    } else if (first == '[') {
      list(']', [&] { out.items.push_back(read()); });
    } else if (first == '"') {
      out.text = string();
    } else if (first == 't' || first == 'f' || first == 'n') {
      out.number = first == 't' ? 1.0 : 0.0;
      while (*at_ >= 'a' && *at_ <= 'z') ++at_;
    } else {
      char* end = nullptr;
      out.number = std::strtod(at_, &end);
      if (end == at_) throw std::runtime_error(std::string("no JSON at: ") + at_);
      at_ = end;
    }
    return out;
  }

 private:
  char skip() {
    while (*at_ == ' ' || *at_ == '\n' || *at_ == '\r' || *at_ == '\t') ++at_;
    return *at_;
  }
  void expect(char wanted) {
    if (skip() != wanted) throw std::runtime_error(std::string("no JSON at: ") + at_);
    ++at_;
  }
  template <typename Entry>
  void list(char last, Entry entry) {
    ++at_;
    if (skip() == last) return void(++at_);
    for (;;) {
      entry();
      if (skip() == last) return void(++at_);
      expect(',');
    }
  }
  std::string string() {
    expect('"');
    std::string out;
    for (; *at_ != '"'; ++at_) {
      if (*at_ == '\0') throw std::runtime_error("a JSON text does not end");
      if (*at_ == '\\') ++at_;
      out += *at_;
    }
    ++at_;
    return out;
  }

  const char* at_;
};

struct Use {
  std::string action, slot;
  int start_frame = 0;
  double start_s = 0.0, duration_s = 0.0;
  Json params;  // params["angle_deg"].number, params["target"].vec3(), params["clip"].text

  // The fraction of the action that is over: 0 until its start, 1 from its end on.
  double progress(double time_s) const {
    if (time_s >= start_s + duration_s) return 1.0;
    return time_s <= start_s ? 0.0 : (time_s - start_s) / duration_s;
  }
};

struct Request {
  std::string character;
  double seed = 0.0, rate_hz = 60.0;
  int frames = 0;
  std::vector<Use> uses;
  Json parts;
};

// The frames of a reply. All of them begin as the rest pose.
class Motion {
 public:
  Motion(const Json& joints, int frames) : width_(3 + 4 * joints.items.size()), rest_(width_) {
    const Json& root = joints.items.at(0)["position"];
    for (std::size_t i = 0; i < root.items.size(); ++i) rest_[i] = root.items[i].number;
    for (std::size_t j = 0; j < joints.items.size(); ++j) {
      rest_[6 + 4 * j] = 1.0;
      const Json& rotation = joints.items[j]["rotation"];
      for (std::size_t i = 0; i < rotation.items.size(); ++i) rest_[3 + 4 * j + i] = rotation.items[i].number;
    }
    values_.reserve(width_ * static_cast<std::size_t>(frames));
    for (int frame = 0; frame < frames; ++frame) values_.insert(values_.end(), rest_.begin(), rest_.end());
  }

  int frames() const { return static_cast<int>(values_.size() / width_); }

  // The row of a frame: the position of the root, then x, y, z, w for each joint in the manifest's order.
  double* row(int frame) { return values_.data() + width_ * static_cast<std::size_t>(frame); }

  void set(int frame, int joint, const Quat& q) {
    for (int i = 0; i < 4; ++i) row(frame)[3 + 4 * joint + i] = q[static_cast<std::size_t>(i)];
  }

  // Turns a joint by an angle about an axis of length 1 of its own frame, starting from its rest rotation.
  void turn(int frame, int joint, const Vec3& axis, double angle_deg) {
    const double half = angle_deg * 3.14159265358979323846 / 360.0, s = std::sin(half), w = std::cos(half);
    const double x = axis[0] * s, y = axis[1] * s, z = axis[2] * s;
    const double* r = rest_.data() + 3 + 4 * joint;
    set(frame, joint, {r[3] * x + r[0] * w + r[1] * z - r[2] * y, r[3] * y - r[0] * z + r[1] * w + r[2] * x,
                       r[3] * z + r[0] * y - r[1] * x + r[2] * w, r[3] * w - r[0] * x - r[1] * y - r[2] * z});
  }

  const std::vector<double>& values() const { return values_; }

 private:
  std::size_t width_;
  std::vector<double> rest_, values_;
};

using Generate = std::function<void(const Request&, Motion&)>;

namespace detail {

inline Request request_of(const Json& message) {
  Request out;
  out.character = message["character"].text;
  out.seed = message["seed"].number;
  out.rate_hz = message["rate_hz"].number;
  out.frames = static_cast<int>(message["frames"].number);
  out.parts = message["parts"];
  for (const Json& use : message["timeline"].items)
    out.uses.push_back({use["action"].text, use["slot"].text, static_cast<int>(use["start_frame"].number),
                        use["start_s"].number, use["duration_s"].number, use["params"]});
  return out;
}

inline const Json& joints_of(const Json& manifest, const std::string& character) {
  for (const Json& one : manifest["characters"].items)
    if (one["name"].text == character) return one["joints"];
  throw std::runtime_error("there is no character '" + character + "'");
}

// The stream to Contort. Later output of the program goes to standard error.
inline std::FILE* take_stdout() {
  std::fflush(stdout);
#ifdef _WIN32
  const int copy = _dup(1);
  _dup2(2, 1);
  _setmode(copy, _O_BINARY);
  return _fdopen(copy, "wb");
#else
  const int copy = dup(1);
  dup2(2, 1);
  return fdopen(copy, "wb");
#endif
}

inline void send(std::FILE* sink, const std::string& line, const void* bytes = nullptr, std::size_t count = 0) {
  std::fwrite(line.data(), 1, line.size(), sink);
  std::fputc('\n', sink);
  if (count > 0) std::fwrite(bytes, 1, count, sink);
  std::fflush(sink);
}

inline void send_error(std::FILE* sink, const std::string& id, const char* kind, std::string text) {
  for (char& c : text)
    if (c == '"' || c == '\\' || static_cast<unsigned char>(c) < 0x20) c = ' ';
  send(sink, R"({"id":)" + id + R"(,"error":")" + kind + R"(","text":")" + text + "\"}");
}

inline void answer(std::FILE* sink, const Json& message, const Json& manifest, const Generate& generate) {
  const std::string id = std::to_string(static_cast<long long>(message["id"].number));
  try {
    const Request request = request_of(message);
    Motion motion(joints_of(manifest, request.character), request.frames);
    generate(request, motion);
    const std::vector<double>& wide = motion.values();
    const std::vector<float> narrow(manifest["frames"].text == "f32" ? wide.begin() : wide.end(), wide.end());
    const bool is_wide = narrow.empty();
    const std::size_t count = wide.size() * (is_wide ? sizeof(double) : sizeof(float));
    const void* bytes = is_wide ? static_cast<const void*>(wide.data()) : narrow.data();
    send(sink, R"({"id":)" + id + R"(,"bytes":)" + std::to_string(count) + "}", bytes, count);
  } catch (const Refused& reason) {
    send_error(sink, id, "refused", reason.what());
  } catch (const std::exception& reason) {
    send_error(sink, id, "failed", reason.what());
  }
}

}  // namespace detail

// Answers requests until Contort closes the connection. `manifest` is JSON on one or more lines; "contort": 1 is part
// of it. Returns the exit code of the program.
inline int serve(const std::string& manifest, const Generate& generate) {
  std::ios::sync_with_stdio(false);
  std::FILE* sink = detail::take_stdout();
  const Json known = JsonReader(manifest).read();
  std::string hello = manifest;
  for (char& c : hello)
    if (c == '\n') c = ' ';
  for (std::string line; std::getline(std::cin, line);) {
    const Json message = JsonReader(line).read();
    if (message["op"].text == "hello") detail::send(sink, hello.substr(hello.find('{')));
    if (message["op"].text == "generate") detail::answer(sink, message, known, generate);
  }
  return 0;
}

}  // namespace contort_guest
