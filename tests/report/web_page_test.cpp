// SPDX-License-Identifier: Apache-2.0
#include "invsim/report/web_page.h"

#include <gmock/gmock.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "invsim/base/error.h"
#include "invsim/report/base64.h"

namespace invsim {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

WebPage TwoFrames() {
  WebPage page;
  page.title = "A <title>";
  page.lead = "It went well.";
  page.facts = {{"vertices", "3"}};
  page.charts = {{"residual", "time [s]", {0, 0.1}, {{"r", {1, 2}}}}};
  page.times = {0, 0.1};
  PageMesh mesh;
  mesh.name = "cloth</script>";
  mesh.faces.resize(3, 1);
  mesh.faces << 0, 1, 2;
  Points x(3, 3);
  x << 0, 1, 0,   //
      0, 0, 0.5,  //
      0, 0, 0;
  mesh.frames = {x, x.array() + 1.0};
  mesh.quantity = "stress [N/m]";
  mesh.values = {Vector3d(0, 1, 2), Vector3d(2, 2, 2)};
  page.meshes = {mesh};
  return page;
}

nlohmann::json Data(const std::string& html) {
  const std::string open = "type=\"application/json\">";
  const size_t begin = html.find(open) + open.size();
  return nlohmann::json::parse(
      html.substr(begin, html.find("</script>", begin) - begin));
}

TEST(WebPage, HoldsFactsChartsAndMeshes) {
  const std::string html = FormatWebPage(TwoFrames());
  EXPECT_THAT(html,
              AllOf(HasSubstr("A &lt;title&gt;"),
                    HasSubstr("It went well."),
                    HasSubstr("<td>vertices</td><td>3</td>"),
                    HasSubstr("<svg"),
                    HasSubstr("<canvas")));
  // What is looked at first is above; the script finds the charts.
  EXPECT_LT(html.find("<canvas"), html.find("<svg"));
  EXPECT_LT(html.find("<svg"), html.find("<script"));
  const nlohmann::json data = Data(html);
  EXPECT_EQ(data["times"], (std::vector<double>{0, 0.1}));
  const nlohmann::json& mesh = data["meshes"][0];
  EXPECT_EQ(mesh["name"], "cloth</script>");
  EXPECT_EQ(mesh["vertices"], 3);
  EXPECT_EQ(mesh["faces"], Base64({"\0\0\0\0\1\0\0\0\2\0\0\0", 12}));
  EXPECT_EQ(mesh["frames"].size(), 2u);
  // The box is 2 wide: the vertex at x = 1 is at 32767.5 of 65535.
  EXPECT_DOUBLE_EQ(mesh["step"], 2.0 / 65535);
  EXPECT_EQ(mesh["frames"][0],
            Base64({"\0\0\0\0\0\0\x00\x80\0\0\0\0\0\0\x00\x40\0\0", 18}));
  EXPECT_EQ(mesh["most"], 2.0);
  EXPECT_EQ(mesh["values"][0], Base64({"\x00\x80\xff", 3}));
}

TEST(WebPage, NeedsNothingFromOutside) {
  const std::string html = FormatWebPage(TwoFrames());
  EXPECT_THAT(html,
              AllOf(Not(HasSubstr("http:")),
                    Not(HasSubstr("https:")),
                    Not(HasSubstr("src=")),
                    Not(HasSubstr("href="))));
}

TEST(WebPage, WithoutMeshesHasNoViewer) {
  WebPage page = TwoFrames();
  page.meshes.clear();
  EXPECT_THAT(FormatWebPage(page),
              AllOf(Not(HasSubstr("<canvas")), Not(HasSubstr("<script"))));
}

TEST(WebPage, RefusesWhatDoesNotFitTogether) {
  WebPage page = TwoFrames();
  page.meshes[0].frames.pop_back();
  EXPECT_THROW(FormatWebPage(page), Error);
  page = TwoFrames();
  page.meshes[0].values[1].resize(2);
  EXPECT_THROW(FormatWebPage(page), Error);
  page = TwoFrames();
  page.meshes[0].faces(0, 0) = 3;
  EXPECT_THROW(FormatWebPage(page), Error);
  page = TwoFrames();
  page.meshes[0].frames[1](0, 0) = NAN;
  EXPECT_THROW(FormatWebPage(page), Error);
}

}  // namespace
}  // namespace invsim
