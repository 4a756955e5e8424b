#include "renders/static_page.h"

#include "model/core/hash.h"
#include "renders/html.h"
#include "renders/page_files.h"

namespace contort {

namespace {

std::string style_sheet() {
  for (const StockFile& file : page_files())
    if (file.name == "page.css") return std::string(file.text);
  return "";
}

}  // namespace

std::string static_page(std::string_view title, std::string_view own_style, const std::string& body) {
  const std::string nonce = content_id(body);
  return "<!doctype html>\n<html lang='en'>\n<head>\n<meta charset='utf-8'>\n"
         "<meta http-equiv='Content-Security-Policy' content=\"default-src 'none'; img-src 'self' file: data:; style-src "
         "'nonce-" + nonce + "'; base-uri 'none'; form-action 'none'\">\n"
         "<meta name='viewport' content='width=device-width, initial-scale=1'>\n"
         "<meta name='color-scheme' content='light dark'>\n<title>" + html_text(title) +
         "</title>\n<link rel='icon' href='data:,'>\n<style nonce='" + nonce + "'>\n" + style_sheet() +
         std::string(own_style) + "</style>\n</head>\n<body>\n" + body + "</body>\n</html>\n";
}

}  // namespace contort
