#include "deck/xml.hpp"

#include <Teuchos_StringInputSource.hpp>
#include <Teuchos_XMLObject.hpp>
#include <algorithm>

#include "base/errors.hpp"
#include "base/numbers.hpp"

namespace strut::deck {

namespace {

// Teuchos writes file, throw number and condition before its own message: "XML parse error at line 7: …".
void add_syntax_error(const std::string& what, Problems& problems) {
  const std::string mark = "XML parse error at ";
  const std::size_t begin = what.find(mark);
  if (begin == std::string::npos) {
    problems.add("XML", "the file is empty; expected a <ParameterList>");
    return;
  }
  std::string text(trimmed(what.substr(begin + mark.size())));
  if (text.find("attribute value") != std::string::npos) {
    text += " (inside a value write &lt; for < and &amp; for &, and close its quotes)";
  }
  const std::size_t colon = text.find(": ");
  problems.add(text.substr(0, colon), "malformed XML: " + text.substr(std::min(text.size(), colon + 2)));
}

// The attributes that are not known. Teuchos lists attributes only in the text of the head, <Parameter name="Density"
// …>, whose values are not escaped, so the known ones are taken out first.
std::vector<std::string> unknown_attributes(const Teuchos::XMLObject& xml, const std::vector<std::string>& known) {
  std::string head = xml.header();
  for (const std::string& name : known) {
    const std::string text = " " + name + "=\"" + (xml.hasAttribute(name) ? xml.getAttribute(name) : "") + "\"";
    if (const std::size_t at = head.find(text); at != std::string::npos) head.erase(at, text.size());
  }
  std::vector<std::string> names;
  for (std::size_t at = head.find(' '); at < head.size();) {
    const std::size_t is = head.find('=', ++at);
    if (is == std::string::npos) break;
    names.push_back(head.substr(at, is - at));
    at = head.find(head[is + 1], is + 2);  // the closing quote
    at = at == std::string::npos ? at : head.find(' ', at);
  }
  return names;
}

// Refuses attributes that say nothing here. Teuchos' writer adds the last ones.
void check_attributes(const Teuchos::XMLObject& xml, std::vector<std::string> known, const std::string& path,
                      Problems& problems) {
  const std::vector<std::string> expected = known;
  for (const char* written : {"id", "docString", "isDefault", "isUsed", "validatorId", "xmlns"})
    known.push_back(written);
  for (const std::string& name : unknown_attributes(xml, known)) {
    if (name.starts_with("xmlns:")) continue;
    problems.add(path,
                 "unknown attribute '" + name + "'" + did_you_mean(name, expected) + "; expected " + joined(expected));
  }
}

// The text between the tags of an element.
std::string text_within(const Teuchos::XMLObject& xml) {
  std::string all;
  for (int i = 0; i < xml.numContentLines(); ++i) {
    const std::string text(trimmed(xml.getContentLine(i)));
    all += (all.empty() || text.empty() ? "" : " ") + text;
  }
  return all;
}

void check_is_empty(const Teuchos::XMLObject& xml, const std::string& path, Problems& problems) {
  std::string within = text_within(xml);
  if (xml.numChildren() > 0) within = "<" + xml.getChild(0).getTag() + " …>";
  if (!within.empty())
    problems.add(path, "'" + within + "' before its </Parameter>; expected <Parameter …/>, with nothing inside");
}

void read_parameter(const Teuchos::XMLObject& xml, const std::string& path, List& list, Problems& problems) {
  const auto attribute = [&](const char* name) { return xml.hasAttribute(name) ? xml.getAttribute(name) : ""; };
  const Parameter parameter{attribute("name"), attribute("type"), attribute("value")};
  if (parameter.name.empty()) {
    problems.add(path_to(path, "<Parameter>"), "has no name; expected the attributes name, type and value");
  } else {
    list.parameters.push_back(parameter);
  }
  const std::string here = path_to(path, parameter.name.empty() ? "<Parameter>" : parameter.name);
  check_attributes(xml, {"name", "type", "value"}, here, problems);
  check_is_empty(xml, here, problems);
}

// Teuchos' own writer adds an empty <Validators/> to every list of a file.
bool is_harmless(const Teuchos::XMLObject& xml) { return xml.getTag() == "Validators" && xml.numChildren() == 0; }

// Checks the text before Teuchos parses it, because Teuchos recurses for each level, and would take the words of a
// document type for text. Quotes contain no tags: Teuchos rejects a '<' in a value.
std::string problem_before_parsing(const std::string& text) {
  constexpr int deepest = 100;
  int depth = 0;
  for (std::size_t at = text.find('<'); at != std::string::npos; at = text.find('<', at + 1)) {
    if (text.compare(at, 4, "<!--") == 0) {
      at = text.find("-->", at);
      if (at == std::string::npos) return "";
      continue;
    }
    if (text.compare(at, 2, "<!") == 0) {
      return "'" + text.substr(at, 20) + "': no document type, entities or CDATA; expected elements only";
    }
    const std::size_t end = text.find('>', at);
    const bool closes = text.compare(at, 2, "</") == 0, is_empty = end != std::string::npos && text[end - 1] == '/';
    if (closes) --depth;
    if (!closes && !is_empty && text.compare(at, 2, "<?") != 0) ++depth;
    if (depth > deepest) return "more than " + std::to_string(deepest) + " elements within each other";
  }
  return "";
}

List read_list(const Teuchos::XMLObject& xml, const std::string& path, Problems& problems) {
  List list;
  if (xml.hasAttribute("name")) list.name = xml.getAttribute("name");
  const std::string here = path.empty() ? "(top)" : path;
  check_attributes(xml, {"name", "type"}, here, problems);
  const std::string text = text_within(xml);
  if (!text.empty()) problems.add(here, "stray text '" + text + "'");
  for (int i = 0; i < xml.numChildren(); ++i) {
    const Teuchos::XMLObject child = xml.getChild(i);
    if (child.getTag() == "Parameter") {
      read_parameter(child, path, list, problems);
    } else if (child.getTag() == "ParameterList" && child.hasAttribute("name")) {
      list.lists.push_back(read_list(child, path_to(path, child.getAttribute("name")), problems));
    } else if (!is_harmless(child)) {
      problems.add(path_to(path, "<" + child.getTag() + ">"), "expected <ParameterList name=\"…\"> or <Parameter …/>");
    }
  }
  return list;
}

}  // namespace

std::optional<List> parse_xml(const std::string& text, Problems& problems) {
  const std::string problem = problem_before_parsing(text);
  if (!problem.empty()) {
    problems.add("XML", problem);
    return std::nullopt;
  }
  try {
    const Teuchos::XMLObject root = Teuchos::StringInputSource(text).getObject();
    if (root.getTag() == "ParameterList") return read_list(root, "", problems);
    problems.add("<" + root.getTag() + ">", "expected the outermost element to be <ParameterList>");
  } catch (const std::exception& error) {
    add_syntax_error(error.what(), problems);
  }
  return std::nullopt;
}

}  // namespace strut::deck
