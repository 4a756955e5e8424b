// contort serve: shows a corpus for triage, and plays characters, in a web page.
#include <signal.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <filesystem>
#include <thread>

#include "cli/catalogue_fields.h"
#include "cli/commands.h"
#include "cli/engine_files.h"
#include "cli/input.h"
#include "cli/program_files.h"
#include "model/core/files.h"
#include "model/spec/dynamics_desc.h"
#include "server/app.h"
#include "server/http.h"
#include "server/scratch.h"

namespace contort::cli {

namespace fs = std::filesystem;

namespace {

constexpr int kConnectionsBesideStreams = 96;  // connections besides streams; half as many for one client

struct ServeOptions {
  server::HttpConfig http;
  server::Limits limits;
  BrokerLimits workers;
  std::string corpus, report, token;
  std::vector<std::string> hosts;
  bool read_only = false;
};

std::string bracketed(const std::string& host) { return host.find(':') == std::string::npos ? host : "[" + host + "]"; }

std::vector<std::string> hosts_of(const ServeOptions& options, int port) {
  const std::string end = ":" + std::to_string(port);
  std::vector<std::string> hosts = {"127.0.0.1" + end, "localhost" + end, "[::1]" + end,
                                    bracketed(options.http.host) + end};
  for (const std::string& host : options.hosts) hosts.insert(hosts.end(), {host, host + end});
  if (port == 80) hosts.insert(hosts.end(), {"127.0.0.1", "localhost", "[::1]", options.http.host});
  return hosts;
}

Json limits_json(const server::Limits& limits) {
  return {{"sessions", limits.sessions},       {"sessions_of_client", limits.sessions_of_client},
          {"streams", limits.streams},         {"streams_of_client", limits.streams_of_client},
          {"calls_per_s", limits.calls_per_s}, {"cpu_s_per_minute", limits.cpu_s_per_minute},
          {"spec_bytes", limits.spec_bytes},   {"library_bytes", limits.library_bytes},
          {"take_s", limits.take_s},           {"most_s", limits.most_s}};
}

std::string catalogue(Generator& generator, const ServeOptions& options) {
  const Library& library = *generator.manifest().library;
  Json sockets = Json::object(), modes = Json::array(), objects = Json::array();
  for (const auto& [name, part] : library.parts) {
    sockets[name] = Json::array();
    for (const SocketDesc& socket : part.sockets) sockets[name].push_back(socket.name);
  }
  for (const auto& [name, object] : library.objects) objects.push_back(name);
  for (const std::string_view mode : mode_names()) modes.push_back(std::string(mode));
  return Json{{"version", CONTORT_VERSION},
              {"read_only", options.read_only},
              {"corpus", !options.corpus.empty()},
              {"characters", list_characters(generator)},
              {"parts", list_parts(generator)},
              {"objects", objects},
              {"sockets", sockets},
              {"actions", list_actions(generator)},
              {"checks", list_checks(generator)},
              {"modes", modes},
              {"limits", limits_json(options.limits)}}
      .dump(-1, ' ', false, Json::error_handler_t::replace);
}

std::vector<std::string> own_call(const Context& context) {
  std::vector<std::string> call = {own_path(), "--gl", context.gl};
  for (const std::string& argument : context.sources.arguments()) call.push_back(argument);
  if (!context.settings_file.empty()) call.insert(call.end(), {"--settings", context.settings_file});
  if (!context.today.empty()) call.insert(call.end(), {"--today", context.today});
  return call;
}

// All threads inherit the blocked signals; only the main thread receives them, when it waits for one.
sigset_t block_signals() {
  sigset_t ends;
  sigemptyset(&ends);
  for (const int number : {SIGINT, SIGTERM, SIGHUP}) sigaddset(&ends, number);
  ::pthread_sigmask(SIG_BLOCK, &ends, nullptr);
  return ends;
}

void wait_for_end(server::App& app, const sigset_t& ends) {
  const timespec second{1, 0};
  for (;;) {
    app.tick();
    if (::sigtimedwait(&ends, nullptr, &second) > 0) return;
  }
}

Result<Done> check(const ServeOptions& options) {
  if (!server::is_loopback(options.http.host) && options.token.empty())
    return Issue{"serve.no_token", "",
                 "--host " + options.http.host + " can be reached from other machines: give --token, or use 127.0.0.1"};
  if (!options.token.empty() && options.token.size() < 16)
    return Issue{"serve.short_token", "", "a token needs at least 16 characters"};
  for (const char c : options.token)
    if (!std::isalnum(static_cast<unsigned char>(c)) && c != '-' && c != '_')
      return Issue{"serve.bad_token", "", "a token consists of letters, digits, - and _"};
  return Done{};
}

void announce(const ServeOptions& options, int port) {
  std::printf("contort serves http://%s:%d/%s\n", bracketed(options.http.host).c_str(), port,
              options.token.empty() ? "" : "?token=…");
  std::printf("playground: /play, calls: /api, metrics: /metrics; end with Ctrl-C\n");
  std::fflush(stdout);
}

server::AppConfig app_config(const ServeOptions& options, int port, const server::Scratch& scratch, Context& context) {
  server::AppConfig config;
  config.guard = {hosts_of(options, port), options.token};
  config.read_only = options.read_only, config.corpus = options.corpus;
  config.report = options.corpus.empty() ? "" : options.report.empty() ? scratch.folder("report") : options.report;
  config.pages = pages_path();
  config.scratch = scratch.folder("files");
  config.program = own_call(context);
  config.today = [&context] { return context.day(); };
  return config;
}

// Signals are blocked first, so that no signal ends the server before its folder is removed.
void serve(const ServeOptions& options, Generator& generator, const CheckSettings& settings, Context& context) {
  const std::string about = catalogue(generator, options);
  const Result<std::string> library =
      has_engine() ? library_script(*generator.manifest().library, context) : std::string();
  if (!library) return context.fail(library.issue());
  const sigset_t ends = block_signals();
  server::Engine engine(options.limits, options.workers, generator, settings, std::string("contort ") + CONTORT_VERSION);
  server::Http http(options.http);
  const Result<int> port = http.bind();
  if (!port) return context.fail(port.issue());
  const auto scratch = server::Scratch::make();
  if (!scratch) return context.fail(scratch.issue(), kInternal);
  server::AppConfig config = app_config(options, *port, **scratch, context);
  config.catalogue = about, config.library = *library;
  server::App app(std::move(config), engine);
  std::thread answers([&] {
    http.run({[&](const server::Request& head) { return app.refuse(head); },
              [&](const server::Request& request) { return app.perform(request); }});
  });
  announce(options, *port);
  wait_for_end(app, ends);
  app.close();
  http.stop();
  answers.join();
}

// A missing corpus is probably a mistyped name, so it is not created.
Result<std::string> open_corpus(const ServeOptions& options) {
  Result<Corpus> corpus = Corpus::open(options.corpus);
  if (corpus && !options.read_only) corpus = Corpus::create(options.corpus);  // checks whether the corpus is writable
  if (!corpus) return corpus.issue();
  return fs::absolute(options.corpus).string();
}

void run(ServeOptions options, Context& context) {
  Generator* generator = context.load_generator();
  if (generator == nullptr) return;
  const Result<CheckSettings> settings = context.load_settings_without_waivers();
  if (!settings) return context.fail(settings.issue());
  if (const Result<Done> fine = check(options); !fine) return context.fail(fine.issue());
  if (!options.corpus.empty()) {
    const Result<std::string> corpus = open_corpus(options);
    if (!corpus) return context.fail(corpus.issue());
    options.corpus = *corpus;
  }
  if (options.limits.sessions_of_client > options.limits.sessions)
    options.limits.sessions = options.limits.sessions_of_client;
  options.http.connections = options.limits.streams + kConnectionsBesideStreams;
  options.http.connections_of_client = options.limits.streams_of_client + kConnectionsBesideStreams / 2;
  options.http.most_body = static_cast<std::size_t>(std::max(options.limits.spec_bytes, options.limits.library_bytes));
  serve(options, *generator, *settings, context);
}

void add_limits(CLI::App& command, ServeOptions& options) {
  const CLI::Range some(1, 100000);
  server::Limits& limits = options.limits;
  const char* group = "Limits";
  const auto add = [&](const char* name, auto& value, const char* help) {
    command.add_option(name, value, help)->check(some)->capture_default_str()->group(group);
  };
  add("--sessions", limits.sessions, "Greatest number of sessions at a time");
  add("--sessions-per-client", limits.sessions_of_client, "Greatest number of sessions of one address");
  add("--streams", limits.streams, "Greatest number of streams at a time");
  add("--streams-per-client", limits.streams_of_client, "Greatest number of streams of one address");
  add("--calls-per-second", limits.calls_per_s, "Greatest number of calls of one address in a second, on average");
  add("--cpu-per-client", limits.cpu_s_per_minute,
      "CPU seconds that one address may use in a minute, on average; five times as many after a pause");
  add("--idle-seconds", limits.idle_s, "Seconds after which an unused session ends");
  add("--waiting-tasks", options.workers.most_waiting, "Greatest number of motions that wait for a worker");
  add("--task-seconds", options.workers.each.seconds, "Greatest time for one motion, in seconds");
  command.add_option("--spec-bytes", limits.spec_bytes, "Greatest size of a call's body, in bytes")
      ->check(CLI::Range(1 << 10, 16 << 20))
      ->capture_default_str()
      ->group(group);
  command.add_option("--take-seconds", limits.take_s, "Length of a take, in seconds (docs/reference/server.md)")
      ->check(CLI::Range(2.0, 60.0))
      ->check(refuse_nan)
      ->capture_default_str()
      ->group(group);
}

}  // namespace

void add_serve(CLI::App& app, Context& context) {
  auto options = std::make_shared<ServeOptions>();
  options->workers.workers = static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
  CLI::App* command = app.add_subcommand("serve", "Browse, triage and drive characters from a web page");
  command
      ->add_option("--corpus", options->corpus,
                   "Existing corpus to show and to triage; failures that sessions show are stored in it")
      ->type_name("DIR");
  command
      ->add_option("--report", options->report,
                   "Folder of the report (default: a temporary folder, removed when the server ends)")
      ->type_name("DIR");
  command->add_option("--host", options->http.host, "Address to listen on")->capture_default_str();
  command->add_option("--port", options->http.port, "Port to listen on; 0: any free port")
      ->check(CLI::Range(0, 65535))
      ->capture_default_str();
  command->add_option("--token", options->token,
                      "Secret that callers must send; required if other machines can reach the server");
  command->add_option("--allow-host", options->hosts, "Host name under which browsers may call the server, such as that of a proxy");
  command->add_flag("--read-only", options->read_only, "Do not change the corpus");
  command->add_option("--workers", options->workers.workers, "Number of processes that generate motions")
      ->check(CLI::Range(1, 256))
      ->capture_default_str();
  add_limits(*command, *options);
  command->footer("Example: contort serve --corpus contort-out/corpus");
  command->callback([options, &context] { run(*options, context); });
}

}  // namespace contort::cli
