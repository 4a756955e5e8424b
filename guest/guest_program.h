// The conversation with a generator that is a program of its own (docs/reference/guests.md).
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>

#include "guest/channels.h"
#include "guest/manifest.h"
#include "process/line_program.h"

namespace contort {

// The ways in which a program can break the protocol. A ProgramEnded has one of them as its signal.
inline constexpr char kNoJson[] = "no JSON";
inline constexpr char kWrongId[] = "wrong id";
inline constexpr char kWrongLength[] = "wrong length";
inline constexpr char kWrongChannels[] = "wrong channels";
inline constexpr char kFailed[] = "failed";  // the program reports its own failure

struct GuestLimits {
  double start_s = 60.0;  // time limit for the manifest
  double case_s = 10.0;   // time limit for a motion
  std::int64_t bytes = std::int64_t{4} << 30;
};

// One line of the generator's answer to a request.
struct GuestAnswer {
  std::optional<std::string> refusal;  // the reason for which the generator refuses the request, in its own words
  std::string bytes;    // the frames
  ChannelFacts channels{};
};

// The size of an answer.
struct AnswerSize {
  int frames = 0;
  std::size_t bytes = 0;
};

class GuestProgram {
 public:
  // Starts the program, with a shell only if the command has special characters of a shell.
  GuestProgram(const std::string& command, const GuestLimits& limits);

  // Exchanges the greeting. Codes generator.ended, generator.silent, generator.bad_token and those of parse_manifest.
  Result<GuestManifest> greet(const ModelReader& models = {});

  // Requests a motion of this size, with the channels that the manifest declares. Throws ProgramEnded if the program
  // ends, is silent, fails, or breaks the protocol; the conversation is then over.
  GuestAnswer ask(const std::string& request, std::int64_t id, const AnswerSize& size,
                  std::span<const GuestChannel> channels);

 private:
  Result<GuestManifest> manifest_in(const std::string& line, const ModelReader& models);
  [[noreturn]] void fail(const std::string& what, const std::string& details);
  std::string read(Ending ending);

  GuestLimits limits_;
  LineProgram program_;
};

}  // namespace contort
