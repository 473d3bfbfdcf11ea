#include "mbs/base/text_file.hpp"
#include "mbs/urdf/detail/reading.hpp"
#include "mbs/urdf/detail/vocabulary.hpp"

#include <algorithm>
#include <map>
#include <tinyxml.h>

namespace cardan::urdf_impl {

namespace {

std::string at_line(std::string_view source, std::string_view xml, std::size_t position) {
    return text(source, ":", 1 + std::count(xml.begin(), xml.begin() + static_cast<long>(position), '\n'), ": ");
}

// The place of the > that ends the tag at `start`. TinyXML also takes values without quotation marks; XML does not.
std::size_t tag_end(std::string_view xml, std::size_t start, std::string_view source) {
    char quote = 0;
    for (std::size_t i = start; i < xml.size(); ++i) {
        if (quote) {
            if (xml[i] == quote) quote = 0;
        } else if (xml[i] == '"' || xml[i] == '\'') {
            quote = xml[i];
        } else if (xml[i] == '>') {
            return i;
        } else if (xml[i] == '=') {
            const std::size_t value = xml.find_first_not_of(" \t\r\n", i + 1);
            if (value != std::string_view::npos && xml[value] != '"' && xml[value] != '\'')
                throw InputError(at_line(source, xml, i) + "is not XML: the value of an attribute stands in no quotes");
        }
    }
    throw InputError(at_line(source, xml, start) + "is not XML: a tag does not end");
}

// TinyXML reads and deletes nested tags by recursion; URDF nests seven deep.
void check_tags(std::string_view xml, std::string_view source) {
    constexpr int deepest = 100;
    int depth = 0;
    for (std::size_t i = xml.find('<'); i < xml.size(); i = xml.find('<', i)) {
        const std::string_view rest = xml.substr(i);
        if (rest.starts_with("<!--")) {
            i = xml.find("-->", i);
        } else if (rest.starts_with("<![CDATA[")) {
            i = xml.find("]]>", i);
        } else if (rest.starts_with("<!") || rest.starts_with("<?")) {
            i = xml.find('>', i);
        } else {
            const std::size_t end = tag_end(xml, i, source);
            if (rest.starts_with("</")) {
                if (--depth < 0)
                    throw InputError(text(at_line(source, xml, i), "is not XML: an end tag without a start"));
            } else if (xml[end - 1] != '/' && ++depth > deepest) {
                throw InputError(at_line(source, xml, i) + "tags", "depth of nesting", depth,
                                 text("at most ", deepest));
            }
            i = end;
        }
    }
}

void parse(TiXmlDocument& document, std::string_view xml, std::string_view source) {
    require_text(xml, source);
    if (xml.find_first_not_of(" \t\r\n") == std::string_view::npos)
        throw InputError(text(source, ": is empty; a URDF document was expected"));
    check_tags(xml, source);
    document.Parse(std::string(xml).c_str(), nullptr, TIXML_ENCODING_UTF8);
    if (document.Error())
        throw InputError(text(source, ":", std::max(1, document.ErrorRow()), ":", std::max(1, document.ErrorCol()),
                              ": is not XML: ", document.ErrorDesc()));
    const TiXmlElement* root = document.RootElement();
    if (!root) throw InputError(text(source, ":1: is not XML: it has no tag"));
    for (const TiXmlNode* node = document.FirstChild(); node; node = node->NextSibling())
        if (node->ToText()) throw InputError(text(source, ":", node->Row(), ": is not XML: text outside of all tags"));
    if (root->ValueStr() != "robot")
        throw InputError(text(source, ":", root->Row()), "root tag", text("<", root->ValueStr(), ">"), "<robot>");
    if (const TiXmlElement* second = root->NextSiblingElement())
        throw InputError(
            text(source, ":", second->Row(), ": a second root tag <", second->ValueStr(), ">; XML has one"));
}

// Attributes are lists of words for XML, whatever the white space between them; urdfdom wants single blanks.
std::vector<std::string> words(const std::string& value) {
    constexpr auto blank = " \t\r\n";
    std::vector<std::string> result;
    for (std::size_t i = value.find_first_not_of(blank); i != std::string::npos;) {
        const std::size_t end = value.find_first_of(blank, i);
        result.push_back(value.substr(i, end - i));
        i = value.find_first_not_of(blank, end);
    }
    return result;
}

class Reader {
public:
    explicit Reader(Outline& out) : out_(out) {}

    void robot(TiXmlElement& root) {
        walk(root, "robot", "robot");
        for (const auto& [path, found] : passed_)
            out_.notes.push_back(
                text(out_.at(found.line), found.what, found.count > 1 ? text(" (", found.count, " times)") : ""));
    }

private:
    struct Passed {
        int line;
        std::string what;
        int count = 0;
    };

    void note(int line, const std::string& what) { out_.notes.push_back(out_.at(line) + what); }

    // Each kind of tag once, with the number of times.
    void pass(const std::string& path, int line, const std::string& what) {
        ++passed_.try_emplace(path, Passed{line, what}).first->second.count;
    }

    std::string label(const TiXmlElement& element, const std::string& path, const std::string& around) {
        if (path != "robot/link" && path != "robot/joint") return around;
        const char* name = element.Attribute("name");
        return text(element.ValueStr(), " '", name ? name : "", "'");
    }

    void walk(TiXmlElement& element, const std::string& path, const std::string& around) {
        const TagRule& rule = *find_tag(path);
        const std::string where = label(element, path, around);
        attributes(element, rule, where);
        if (path == "robot/link") out_.links.push_back({element.Attribute("name"), element.Row()});
        if (path == "robot/joint") joint(element);
        std::vector<std::string> seen;
        for (TiXmlElement* child = element.FirstChildElement(); child;) {
            TiXmlElement* const next = child->NextSiblingElement();
            if (!keep(*child, path, where, seen))
                element.RemoveChild(child);
            else
                walk(*child, path + "/" + child->ValueStr(), where);
            child = next;
        }
        for (const std::string_view needed : rule.needs)
            if (std::find(seen.begin(), seen.end(), needed) == seen.end())
                throw InputError(
                    text(out_.at(element.Row()), where, ": <", element.ValueStr(), "> needs a tag <", needed, ">"));
    }

    bool keep(const TiXmlElement& child, const std::string& path, const std::string& where,
              std::vector<std::string>& seen) {
        const std::string& tag = child.ValueStr();
        const std::string child_path = path + "/" + tag;
        if (tag.starts_with("xacro:"))
            throw InputError(text(out_.at(child.Row()), "tag <", tag,
                                  ">: this is a xacro file; expand it to URDF first (xacro FILE.xacro > FILE.urdf)"));
        const TagRule* rule = find_tag(child_path);
        if (!rule) {
            pass(child_path, child.Row(), text(where, ": unknown tag <", tag, "> in <", last(path), "> is ignored"));
            return false;
        }
        if (!rule->passed_over.empty()) {
            pass(child_path, child.Row(), text(where, ": <", tag, "> is passed over: ", rule->passed_over));
            return false;
        }
        if (!rule->repeats && std::find(seen.begin(), seen.end(), tag) != seen.end()) {
            note(child.Row(), text(where, ": a second <", tag, "> is ignored"));
            return false;
        }
        seen.push_back(tag);
        return true;
    }

    static std::string last(const std::string& path) { return path.substr(path.rfind('/') + 1); }

    void attributes(TiXmlElement& element, const TagRule& rule, const std::string& where) {
        std::vector<std::string> names;
        for (const TiXmlAttribute* a = element.FirstAttribute(); a; a = a->Next()) names.emplace_back(a->Name());
        for (const std::string& name : names) {
            const auto known = std::find_if(rule.attributes.begin(), rule.attributes.end(),
                                            [&](const AttributeRule& a) { return a.name == name; });
            if (known != rule.attributes.end())
                value(element, *known, where);
            else if (name != "xmlns" && !name.starts_with("xmlns:"))
                note(element.Row(),
                     text(where, ": unknown attribute '", name, "' of <", element.ValueStr(), "> is ignored"));
        }
        for (const AttributeRule& attribute : rule.attributes)
            if (attribute.required && !element.Attribute(std::string(attribute.name).c_str()))
                throw InputError(text(out_.at(element.Row()), where, ": <", element.ValueStr(),
                                      "> needs an attribute '", attribute.name, "'"));
    }

    void value(TiXmlElement& element, const AttributeRule& rule, const std::string& where) {
        const std::string name(rule.name), given = element.Attribute(name.c_str());
        const auto refuse = [&](const char* allowed) {
            throw InputError(text(out_.at(element.Row()), where, ": <", element.ValueStr(), ">"), name,
                             "\"" + given + "\"", allowed);
        };
        if (rule.value == ValueKind::text) {
            if (rule.required && given.empty()) refuse("a name");
            return;
        }
        const std::vector<std::string> found = words(given);
        const bool vector = rule.value == ValueKind::vector;
        if (found.size() != (vector ? 3 : 1) ||
            !std::all_of(found.begin(), found.end(), [](const std::string& w) { return read_number(w).good(); }))
            refuse(vector ? "three finite numbers" : "a finite number");
        std::string tidy = found[0];
        for (std::size_t i = 1; i < found.size(); ++i) tidy += " " + found[i];
        element.SetAttribute(name, tidy);
    }

    void joint(const TiXmlElement& element) {
        const auto link = [&](const char* tag) {
            const TiXmlElement* child = element.FirstChildElement(tag);
            const char* name = child ? child->Attribute("link") : nullptr;
            return std::string(name ? name : "");  // missing ones are refused by walk()
        };
        out_.joints.push_back({element.Attribute("name"), element.Attribute("type"), link("parent"), link("child"),
                               element.Row(), element.FirstChildElement("axis") != nullptr,
                               element.FirstChildElement("limit") != nullptr});
    }

    Outline& out_;
    std::map<std::string, Passed> passed_;
};

}  // namespace

Outline outline(std::string_view xml, std::string_view source) {
    TiXmlDocument document;
    parse(document, xml, source);
    Outline out;
    out.source = source;
    TiXmlElement& root = *document.RootElement();
    Reader(out).robot(root);
    out.robot_name = root.Attribute("name");
    TiXmlPrinter printer;
    root.Accept(&printer);
    out.tidy = printer.Str();
    return out;
}

}  // namespace cardan::urdf_impl
