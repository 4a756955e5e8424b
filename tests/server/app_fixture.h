// A server without sockets, with the stock library.
#pragma once

#include <gtest/gtest.h>

#include <memory>
#include <nlohmann/json.hpp>

#include "corpus/corpus.h"
#include "server/app.h"
#include "tests/stage_evaluator.h"
#include "tests/corpus/temp_folder.h"

namespace contort::server {

using Json = nlohmann::json;

inline const std::string kHost = "127.0.0.1:8080";

struct Server {
  TempFolder folder;
  Limits limits;
  std::unique_ptr<Engine> engine;
  std::unique_ptr<App> app;
  std::string client = "127.0.0.1";

  explicit Server(const Limits& wanted = {}, bool with_corpus = true, bool read_only = false,
                  const BrokerLimits& workers = {}) : limits(wanted) {
    engine = std::make_unique<Engine>(limits, workers, stock_generator(), CheckSettings{}, "contort test");
    AppConfig config;
    config.guard.hosts = {kHost};
    config.read_only = read_only;
    if (with_corpus) config.corpus = made_corpus();
    config.scratch = folder / "scratch";
    config.catalogue = "{}";
    config.program = {CONTORT_BINARY_DIR "/contort"};
    config.today = [] { return std::string("2027-02-10"); };
    app = std::make_unique<App>(config, *engine);
  }

  std::string made_corpus() const {
    EXPECT_TRUE(Corpus::create(folder / "corpus"));
    return folder / "corpus";
  }

  Answer call(const std::string& method, const std::string& path, const std::string& body = "") const {
    Request request;
    request.method = method, request.path = path, request.body = body, request.client = client;
    request.headers = {{"host", kHost}, {"content-type", "application/json"}};
    if (const std::size_t at = path.find('?'); at != std::string::npos) {
      request.path = path.substr(0, at);
      const std::string query = path.substr(at + 1);
      for (std::size_t from = 0; from < query.size();) {
        const std::size_t end = std::min(query.find('&', from), query.size()), equals = query.find('=', from);
        request.query[query.substr(from, equals - from)] = query.substr(equals + 1, end - equals - 1);
        from = end + 1;
      }
    }
    return app->answer(request);
  }
  Answer post(const std::string& path, const Json& body) const { return call("POST", path, body.dump()); }
  Json get(const std::string& path) const { return Json::parse(call("GET", path).body); }
};

inline std::string code_of(const Answer& answer) { return Json::parse(answer.body).value("code", ""); }

// A sequence of one action.
inline Json sequence(const std::string& action, const std::string& slot, int frames, const Json& params = Json::object()) {
  return {{"clips", {{{"actions", {{{"action", action}, {"slot", slot}, {"duration_frames", frames}, {"params", params}}}}}}}};
}

inline Json standing(const std::string& character = "mech", const std::string& mode = "kinematic", double rate_hz = 30) {
  return {{"format", "contort.spec/1"},
          {"character", {{"name", character}}},
          {"rate_hz", rate_hz},
          {"dynamics", {{"mode", mode}}}};
}

}  // namespace contort::server
