// SPDX-License-Identifier: BSD-3-Clause
// XML as Gazebo's parser takes it: lines, errors and what is mended.
#include <gtest/gtest.h>

#include "load/xml/xml_parser.hpp"

namespace bubblesim::test::test_xml {
namespace {

XmlElement parsed(const std::string& text, std::vector<Problem>* warnings = nullptr) {
  std::vector<Problem> found;
  XmlElement root = parse_xml(text, "file.xml", found);
  if (warnings != nullptr) *warnings = found;
  return root;
}

std::string problem_of(const std::string& text) {
  try {
    parsed(text);
  } catch (const SceneError& error) {
    return error.what();
  }
  return "it is read";
}

TEST(Xml, HasLinesTextsAndAttributes) {
  const XmlElement root = parsed("<?xml version='1.0'?>\n<a b='1 &lt; 2'>\n <c/>\n <x:d> text \n<!-- no --></x:d></a>");
  EXPECT_EQ(root.line, 2);
  EXPECT_EQ(*root.attribute("b"), "1 < 2");
  ASSERT_EQ(root.children.size(), 2U);
  EXPECT_EQ(root.children[1].line, 4);
  EXPECT_EQ(root.children[1].name, "x:d");
  EXPECT_EQ(root.children[1].text, "text");
  EXPECT_EQ(root.children[1].source().file, "file.xml");
}

TEST(Xml, TextIsThatBetweenCommentsAndSections) {
  EXPECT_EQ(parsed("<a>1 <!-- two -->3<![CDATA[ <4>]]></a>").text, "1 3 <4>");
}

TEST(Xml, AttributesWithoutQuotesAreReadUpToTheNextSpace) {
  std::vector<Problem> warnings;
  const XmlElement root = parsed("<a>\n<b name=left_wheel size=3><c frame=/><d x='1'y='2'/></b></a>", &warnings);
  const XmlElement& b = root.children.at(0);
  EXPECT_EQ(b.given_name(), "left_wheel");
  EXPECT_EQ(*b.attribute("size"), "3");
  EXPECT_EQ(*b.children.at(0).attribute("frame"), "");
  EXPECT_EQ(*b.children.at(1).attribute("y"), "2");
  ASSERT_EQ(warnings.size(), 3U);
  EXPECT_EQ(warnings[0].line, 2);
}

TEST(Xml, IsReadAsTinyXmlReadsIt) {
  EXPECT_EQ(parsed("<!-- first --><?xml version='1.0'?><a>R&D</a>").text, "R&D");
  EXPECT_EQ(parsed("<a><!-- one -- two --></a>").name, "a");
  EXPECT_EQ(parsed("\xef\xbb\xbf<a/>").name, "a");
  EXPECT_EQ(parsed("<!DOCTYPE a [<!ENTITY b 'c'>]><a>&b;</a>").text, "&b;");
  EXPECT_EQ(parsed("<a/><b/>").name, "a");
}

TEST(Xml, InLatin1IsConverted) {
  EXPECT_EQ(parsed("<?xml version='1.0' encoding='UTF-8'?>\n<a>\xfc</a>").text, "\xc3\xbc");
}

TEST(Xml, ThatIsNotWellFormedNamesTheTag) {
  EXPECT_EQ(problem_of("<a>\n<b>\n</c></a>"),
            "file.xml:2: is not well-formed XML: <b> is opened here and closed by </c> in line 3");
  EXPECT_EQ(problem_of("<a>\n<b>"), "file.xml:2: is not well-formed XML: <b> is opened here and has no end tag");
  EXPECT_EQ(problem_of("<a>\n</a></b>").find("file.xml:2: is not well-formed XML: </b> closes nothing"), 0U);
  EXPECT_EQ(problem_of("<a>\n<b name='x/>\n</a>").find("file.xml:"), 0U);
  EXPECT_EQ(problem_of(" \n"), "file.xml: is empty");
  EXPECT_EQ(problem_of("<!-- nothing -->"), "file.xml: contains no XML element");
  EXPECT_EQ(problem_of("no tag"), "file.xml: contains no XML element");
}

TEST(Xml, HasLimits) {
  std::string nested;
  for (int i = 0; i < 300; ++i) nested += "<a>";
  for (int i = 0; i < 300; ++i) nested += "</a>";
  EXPECT_EQ(problem_of(nested), "file.xml:1: elements are nested more than 256 deep");
  EXPECT_NE(problem_of("<a name='" + std::string(2000, 'x') + "'/>").find("has 2000 characters; the maximum is 1000"),
            std::string::npos);
}

TEST(Xml, IsWrittenAsItIsRead) {
  const std::string text = "<a b=\"&lt;&quot;\">\n  <c>1 &amp; 2</c>\n  <d />\n</a>\n";
  EXPECT_EQ(to_xml(parsed(text)), text);
}

}  // namespace
}  // namespace bubblesim::test::test_xml
