// SPDX-License-Identifier: Apache-2.0
#include "invsim/report/web_page.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <nlohmann/json.hpp>
#include <string_view>

#include "invsim/base/error.h"
#include "invsim/report/base64.h"
#include "web_page_parts.h"

namespace invsim {
namespace {

using Json = nlohmann::ordered_json;

// The colours end at this share of all values: a few extreme vertices would
// leave the rest dark.
constexpr double kColorQuantile = 0.99;

void Require(bool good, const std::string& what) {
  if (!good) throw Error(ErrorKind::kInternal, "web page: " + what);
}

void Check(const WebPage& page) {
  for (const PageMesh& mesh : page.meshes) {
    Require(mesh.frames.size() == page.times.size() && !page.times.empty(),
            mesh.name + " has not one frame per time");
    Require(mesh.values.empty() || mesh.values.size() == page.times.size(),
            mesh.name + " has not one set of values per time");
    const Eigen::Index n = mesh.frames[0].cols();
    for (size_t k = 0; k < mesh.frames.size(); ++k) {
      Require(mesh.frames[k].cols() == n && mesh.frames[k].allFinite(),
              mesh.name + " changes its vertices or is not finite");
      Require(mesh.values.empty() || mesh.values[k].size() == n,
              mesh.name + " has not one value per vertex");
    }
    Require(mesh.faces.size() == 0 ||
                (mesh.faces.minCoeff() >= 0 && mesh.faces.maxCoeff() < n),
            mesh.name + " has a face of vertices that are not there");
  }
}

template <typename T>
std::string Encode(const std::vector<T>& values) {
  return Base64({reinterpret_cast<const char*>(values.data()),
                 values.size() * sizeof(T)});
}

double Quantile(const std::vector<VectorXd>& values) {
  std::vector<double> all;
  for (const VectorXd& frame : values)
    all.insert(all.end(), frame.begin(), frame.end());
  if (all.empty()) return 1;
  const auto at = all.begin() + static_cast<std::ptrdiff_t>(kColorQuantile *
                                                            (all.size() - 1));
  std::nth_element(all.begin(), at, all.end());
  return *at > 0 ? *at : 1;
}

// 255 is `most` and more, 0 is zero and less.
std::string EncodeValues(const VectorXd& values, double most) {
  std::vector<std::uint8_t> bytes(values.size());
  for (Eigen::Index i = 0; i < values.size(); ++i)
    bytes[i] = static_cast<std::uint8_t>(
        std::lround(255 * std::clamp(values[i] / most, 0.0, 1.0)));
  return Encode(bytes);
}

std::string EncodePositions(const Points& x, const Vector3d& low, double step) {
  std::vector<std::uint16_t> words(x.size());
  for (Eigen::Index i = 0; i < x.size(); ++i)
    words[i] = static_cast<std::uint16_t>(
        std::lround((x.data()[i] - low[i % 3]) / step));
  return Encode(words);
}

Json MeshJson(const PageMesh& mesh) {
  Vector3d low = mesh.frames[0].rowwise().minCoeff();
  Vector3d high = mesh.frames[0].rowwise().maxCoeff();
  for (const Points& frame : mesh.frames) {
    low = low.cwiseMin(frame.rowwise().minCoeff());
    high = high.cwiseMax(frame.rowwise().maxCoeff());
  }
  const double step = std::max(1e-9, (high - low).maxCoeff() / 65535);
  Json json;
  json["name"] = mesh.name;
  json["behind"] = mesh.behind;
  json["color"] = {mesh.color[0], mesh.color[1], mesh.color[2]};
  json["vertices"] = mesh.frames[0].cols();
  json["faces"] = Encode(std::vector<std::uint32_t>(
      mesh.faces.data(), mesh.faces.data() + mesh.faces.size()));
  json["low"] = {low[0], low[1], low[2]};
  json["step"] = step;
  json["frames"] = Json::array();
  for (const Points& frame : mesh.frames)
    json["frames"].push_back(EncodePositions(frame, low, step));
  const double most = Quantile(mesh.values);
  json["quantity"] = mesh.values.empty() ? "" : mesh.quantity;
  json["most"] = most;
  json["values"] = Json::array();
  for (const VectorXd& values : mesh.values)
    json["values"].push_back(EncodeValues(values, most));
  return json;
}

std::string ViewerScript(const WebPage& page) {
  Json data;
  data["times"] = page.times;
  data["meshes"] = Json::array();
  for (const PageMesh& mesh : page.meshes)
    data["meshes"].push_back(MeshJson(mesh));
  std::string text = data.dump();
  // "</script>" in a name would end the element.
  for (size_t at = 0; (at = text.find("</", at)) != std::string::npos; at += 3)
    text.replace(at, 2, "<\\/");
  return "<script id=\"data\" type=\"application/json\">" + text +
         "</script>\n<script>" + kPageScript + "</script>\n";
}

const char kStage[] =
    "<div id=\"viewer\"><canvas id=\"stage\"></canvas></div>\n"
    "<div id=\"controls\"><button id=\"play\">Play</button>"
    "<input id=\"time\" type=\"range\" min=\"0\" value=\"0\" "
    "aria-label=\"frame\"><span id=\"clock\"></span></div>\n"
    "<p id=\"scale\"></p><p id=\"note\"></p>\n";

std::string Facts(const WebPage& page) {
  std::string html = "<div><table>\n";
  for (const auto& [name, value] : page.facts)
    html += "<tr><td>" + EscapeHtml(name) + "</td><td>" + EscapeHtml(value) +
            "</td></tr>\n";
  return html + "</table></div>\n";
}

}  // namespace

std::string FormatWebPage(const WebPage& page) {
  Check(page);
  std::string html =
      "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">"
      "<meta name=\"viewport\" content=\"width=device-width\"><title>" +
      EscapeHtml(page.title) + "</title><style>" + kPageStyle +
      "</style></head>\n<body><h1>" + EscapeHtml(page.title) + "</h1><p>" +
      EscapeHtml(page.lead) + "</p>\n" + (page.meshes.empty() ? "" : kStage) +
      "<div class=\"columns\">" + Facts(page) + "<div>";
  for (const Chart& chart : page.charts) html += FormatSvg(chart) + "\n";
  html += "</div></div>\n";
  if (!page.details.empty())
    html += "<pre>" + EscapeHtml(page.details) + "</pre>\n";
  // Last, for it looks for the charts.
  if (!page.meshes.empty()) html += ViewerScript(page);
  return html + "</body></html>\n";
}

}  // namespace invsim
