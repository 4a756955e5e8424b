#include "fuzz/base_build.h"

#include <utility>

namespace contort {

namespace {

constexpr double kGreetingSeconds = 30.0;  // enough for a machine under load, which starts programs slowly

Measurement refusal_of(std::int64_t id, Issue issue) {
  Measurement refused;
  refused.id = id, refused.refusal = std::move(issue);
  return refused;
}

Issue issue_of_ending(const Ending& ending) {
  switch (ending.kind) {
    case Ending::Kind::timeout: return {"base.timeout", "", "the base did not answer in time"};
    case Ending::Kind::memory: return {"base.memory", "", "the base used too much memory"};
    default: return {"base.crash", "", "the base ended: " + ending.signal};
  }
}

}  // namespace

void BaseProgram::start(const std::function<void()>& on_wait) {
  program_ = std::make_unique<LineProgram>(command_, limits_, Messages::dropped);
  (void)program_->read_line(on_wait, kGreetingSeconds);  // the hello, which the run has checked before
}

void BaseProgram::ask(const MeasureRequest& request) {
  MeasureRequest numbered = request;
  numbered.id = ++id_;
  line_ = print_line(numbered);
  is_asked_ = program_ != nullptr;
  if (is_asked_) program_->send_line(line_);
}

// A program that ended is dropped, so that the next request starts a new one.
Ending BaseProgram::try_once(const std::function<void()>& on_wait) {
  if (program_ == nullptr) start(on_wait);
  if (!is_asked_) program_->send_line(line_);
  is_asked_ = false;
  Ending ending = program_->read_line(on_wait);
  if (ending.kind != Ending::Kind::finished) program_.reset();
  return ending;
}

Measurement BaseProgram::answer(const std::function<void()>& on_wait) {
  Ending ending = try_once(on_wait);
  if (ending.kind != Ending::Kind::finished) ending = try_once(on_wait);
  if (ending.kind != Ending::Kind::finished) return refusal_of(id_, issue_of_ending(ending));
  Result<Measurement> measured = parse_measurement(ending.result);
  if (measured && measured->id == id_) return std::move(measured).value();
  program_.reset();  // its next line could answer any request
  return refusal_of(id_, measured ? Issue{"base.bad_answer", "/id", "found the answer to another request"}
                                  : Issue{"base.bad_answer", measured.issue().pointer, measured.issue().text});
}

Result<MeasureHello> greet(const std::vector<std::string>& command, const WorkerLimits& limits) {
  LineProgram program(command, limits, Messages::shown);
  const Ending first = program.read_line({}, kGreetingSeconds);
  if (first.kind == Ending::Kind::crash && first.signal == "exit 127")
    return Issue{"against.cannot_start", "", command[0] + " cannot be run; expected a contort program"};
  const Result<MeasureHello> hello =
      first.kind == Ending::Kind::finished ? parse_hello(first.result) : Issue{"", "", issue_of_ending(first).text};
  if (hello) return hello;
  return Issue{"against.no_protocol", "",
               command[0] + " does not answer as " + kMeasureFormat + " (" + hello.issue().text +
                   "); build the base from a version that has `contort measure`"};
}

}  // namespace contort
