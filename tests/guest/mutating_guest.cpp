// A generator that answers each request in one of many wrong ways, chosen by the request's id. It is a program of its
// own, so that it may end, flood, or stop half way.
#include <csignal>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <iostream>
#include <string>

namespace {

constexpr char kManifest[] =
    R"({"contort":1,"name":"mutating","characters":[{"name":"hero","joints":[{"name":"hips","position":[0,1,0]},)"
    R"({"name":"arm","parent":"hips"}]}],"actions":[{"name":"wave"}]})";

std::uint64_t state = 0;

std::uint64_t next() {
  state += 0x9e3779b97f4a7c15ULL;
  std::uint64_t z = state;
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ULL;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebULL;
  return z ^ (z >> 31);
}

std::size_t below(std::size_t count) { return next() % count; }

// The number behind "name": in a request.
long number_of(const std::string& request, const char* name) {
  const std::size_t at = request.find(std::string("\"") + name + "\":");
  return at == std::string::npos ? 0 : std::atol(request.c_str() + at + std::strlen(name) + 3);
}

std::string frames_of(long frames) {
  std::string bytes;
  for (long i = 0; i < frames; ++i) {
    const double row[] = {0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 1};
    bytes.append(reinterpret_cast<const char*>(row), sizeof row);
  }
  return bytes;
}

void flip(std::string& text) {
  for (std::size_t i = 0, count = 1 + below(4); i < count && !text.empty(); ++i)
    text[below(text.size())] = static_cast<char>(next());
}

void write(const std::string& text) { std::fwrite(text.data(), 1, text.size(), stdout), std::fflush(stdout); }

std::string reply_line(long id, std::size_t bytes) {
  return "{\"id\":" + std::to_string(id) + ",\"bytes\":" + std::to_string(bytes) + "}\n";
}

void answer(const std::string& request) {
  const long id = number_of(request, "id");
  state = static_cast<std::uint64_t>(id) * 7919;
  std::string data = frames_of(number_of(request, "frames"));
  std::string line = reply_line(id, data.size());
  switch (below(14)) {
    case 0: return write(line + data);
    case 1: flip(line); return write(line + data);
    case 2: flip(data); return write(line + data);
    case 3: write(line + data.substr(0, below(data.size()))); std::exit(static_cast<int>(below(4)));
    case 4: write(line.substr(0, below(line.size()))); std::raise(SIGSEGV); return;
    case 5: return write(reply_line(id, data.size() + 1 + below(100)) + data);
    case 6: return write("{\"id\":" + std::to_string(id) + ",\"bytes\":-1}\n");
    case 7: return write("{\"id\":" + std::to_string(id) + ",\"bytes\":1e300}\n");
    case 8: return write(std::string(1 + below(200), '[') + "\n");
    case 9: return write("{\"id\":" + std::to_string(id) + ",\"error\":[1],\"text\":{}}\n" + data);
    case 10: return write("{\"id\":" + std::to_string(id) + ",\"error\":\"refused\"}\n");
    case 11: return write(line + data + "and more\n");
    case 12: return write(std::string(1 << 20, 'x') + "\n" + data);
    default:
      for (char& c : data) c = static_cast<char>(next());
      return write(line + data);
  }
}

}  // namespace

int main() {
  for (std::string line; std::getline(std::cin, line);)
    if (line.find("hello") != std::string::npos)
      write(std::string(kManifest) + "\n");
    else
      answer(line);
}
