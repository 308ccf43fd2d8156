// Manual pages in roff.
#include "app/manual.h"
#include "core/version.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <string_view>

namespace cascade {
namespace {

/// Escapes a text, so that roff finds no command in it.
std::string roff(std::string_view text) {
    std::string out;
    bool begins_line = true;
    for (const char c : text) {
        if (begins_line && (c == '.' || c == '\'')) out += "\\&";
        if (c == '\\') out += "\\e";
        else if (c == '-') out += "\\-";
        else out += c;
        begins_line = c == '\n';
    }
    return out;
}

/// Joins the lines of a description into one paragraph.
std::string paragraph(std::string text) {
    std::replace(text.begin(), text.end(), '\n', ' ');
    return roff(text) + "\n";
}

std::string upper(std::string text) {
    for (char& c : text) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
    return text;
}

/// Returns the text for the section NAME, which is the first sentence without its full stop.
std::string in_name_section(const std::string& about) {
    std::string first = about.substr(0, about.find(". "));
    std::replace(first.begin(), first.end(), '\n', ' ');
    if (first.ends_with('.')) first.pop_back();
    return first;
}

std::string head(const std::string& title, const std::string& about) {
    return fmt::format(
        ".\\\" Made from the tables of --help.\n"
        ".TH {} 1 \"\" \"Cascade {}\" \"User Commands\"\n.SH NAME\n{} \\- {}\n",
        roff(upper(title)), version(), roff(title), roff(in_name_section(about)));
}

std::string entry(const ManualOption& option) {
    std::vector<std::string> names;
    for (const std::string& name : option.names) names.push_back("\\fB" + roff(name) + "\\fR");
    return fmt::format(".TP\n{}{}\n{}", fmt::join(names, ", "),
                       option.value.empty() ? "" : " \\fI" + roff(option.value) + "\\fR",
                       paragraph(option.about));
}

/// Lists the options below the headings of --help, in the same order as --help.
std::string options_by_group(const std::vector<ManualOption>& options) {
    std::vector<std::string> groups;
    for (const ManualOption& option : options) {
        if (std::find(groups.begin(), groups.end(), option.group) == groups.end()) {
            groups.push_back(option.group);
        }
    }
    std::string text = ".SH OPTIONS\n";
    for (const std::string& group : groups) {
        if (groups.size() > 1) text += ".SS " + roff(group) + "\n";
        for (const ManualOption& option : options) {
            if (option.group == group) text += entry(option);
        }
    }
    return text;
}

/// Writes the text at the end of --help. Indented lines stay as they are. "Examples:" and "Exit
/// status:" become headings.
std::string examples(std::string_view text) {
    constexpr std::string_view status = "Exit status: ";
    std::string page;
    bool is_indented = false;
    while (!text.empty()) {
        const std::size_t end = std::min(text.find('\n'), text.size());
        const std::string_view line = text.substr(0, end);
        text.remove_prefix(std::min(end + 1, text.size()));
        const bool goes_on =
            line.starts_with(' ') || (is_indented && line.empty() && text.starts_with(' '));
        const std::string gap = page.ends_with(".SH EXAMPLES\n") ? "" : ".PP\n";
        if (goes_on != is_indented) page += goes_on ? gap + ".EX\n" : ".EE\n";
        is_indented = goes_on;
        if (line == "Examples:" || line == "Example:") page += ".SH EXAMPLES\n";
        else if (line.starts_with(status))
            page += ".SH \"EXIT STATUS\"\n" + roff(line.substr(status.size())) + "\n";
        else if (!line.empty()) page += (goes_on ? "" : gap) + roff(line) + "\n";
    }
    if (is_indented) page += ".EE\n";
    return page;
}

std::string see_also(const std::vector<std::string>& pages) {
    std::vector<std::string> names;
    for (const std::string& page : pages) names.push_back("\\fB" + roff(page) + "\\fR(1)");
    return fmt::format(".SH \"SEE ALSO\"\n{}\n", fmt::join(names, ",\n"));
}

}  // namespace

std::string man_page(const Manual& manual) {
    std::string page = head("cascade", manual.about);
    page +=
        ".SH SYNOPSIS\n\\fBcascade\\fR \\fICOMMAND\\fR [\\fIarguments and options\\fR]\n"
        ".SH DESCRIPTION\n" +
        paragraph(manual.about) + ".SH COMMANDS\n";
    std::vector<std::string> pages;
    for (const ManualCommand& command : manual.commands) {
        page += fmt::format(".TP\n\\fB{}\\fR\n{}", roff(command.name), paragraph(command.about));
        pages.push_back("cascade-" + command.name);
    }
    return page + options_by_group(manual.options) + examples(manual.examples) + see_also(pages);
}

std::string man_page(const ManualCommand& command) {
    std::string page = head("cascade-" + command.name, command.about);
    page += fmt::format(".SH SYNOPSIS\n\\fBcascade {}\\fR", roff(command.name));
    for (const ManualOption& argument : command.arguments) {
        page += fmt::format(" \\fI{}\\fR{}", roff(argument.names.front()),
                            argument.is_repeatable ? "\\&..." : "");
    }
    page += " [\\fIoptions\\fR]\n.SH DESCRIPTION\n" + paragraph(command.about);
    if (!command.arguments.empty()) page += ".SH ARGUMENTS\n";
    for (const ManualOption& argument : command.arguments) page += entry(argument);
    return page + options_by_group(command.options) + examples(command.examples) +
           see_also({"cascade"});
}

}  // namespace cascade
