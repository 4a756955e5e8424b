// The rights that the server gives to its own pages.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

#include "model/core/files.h"
#include "tests/server/app_fixture.h"

namespace contort::server {
namespace {

TEST(Pages, ThePlaygroundMayUseWebAssemblyOnlyWithALibraryForIt) {
  Server server({}, false);
  AppConfig config;
  config.guard.hosts = {kHost};
  config.pages = server.folder / "pages";
  std::filesystem::create_directory(config.pages);
  ASSERT_TRUE(write_file(config.pages + "/play.html", "<!doctype html>\n<html lang=\"en\"></html>\n"));
  for (const std::string library : {"", "window.contortLibrary = [];\n"}) {
    config.library = library;
    server.app = std::make_unique<App>(config, *server.engine);
    const Answer page = server.call("GET", "/play"), script = server.call("GET", "/page/library.js");
    ASSERT_EQ(page.status, 200) << page.body;
    EXPECT_EQ(page.body.find("<html data-engine lang") != std::string::npos, !library.empty()) << page.body;
    const auto policy = std::ranges::find(page.headers, "Content-Security-Policy",
                                          &std::pair<std::string, std::string>::first);
    ASSERT_NE(policy, page.headers.end());
    EXPECT_EQ(policy->second.find("script-src 'self' 'wasm-unsafe-eval';") != std::string::npos, !library.empty());
    EXPECT_EQ(script.status, library.empty() ? 404 : 200);
    EXPECT_EQ(script.body == library, !library.empty());
  }
}

}  // namespace
}  // namespace contort::server
