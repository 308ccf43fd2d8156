#!/usr/bin/env bash
# Every source opens with a comment that says what the file is for, and comments and documents name no
# file that does not exist. Needs no build: reads $SOURCE.
#
# 1. The first line of each .cpp outside of tests/ and bench/, and of each .h and .cpp in the rooms of
#    cmake/rooms.txt, is a comment.
# 2. A path is a word that begins with one of the project's folders and a slash, in a comment of a
#    .cpp, .h, .def, .sh or CMake file or anywhere in a .md file. It names a file, a file without its
#    ending (.h, .cpp, .def, .md, .sh), or a folder; * stands for any letters. Words with a part in
#    capitals, as in examples/NAME.png, are placeholders.
# 3. A word `Suite.Test` of spec/promises.md names a test, where * stands for any letters.
# 4. No text contains the marks of a merge that was not finished.
# 5. A shared library whose name a source gives to dlopen() is named in package/late.txt.
set -u
cd "${SOURCE:-$(dirname "${BASH_SOURCE[0]}")/..}" || exit 1

folders=$(sed -nE 's/^([a-z]+)[/:].*/\1/p' cmake/rooms.txt | sort -u)
all_folders="$folders bench cmake docs examples include package page spec tests"

# Prints the files whose first line is no comment.
without_opening() {
    local file line
    for file; do
        IFS= read -r line <"$file"
        [[ $line == //* ]] || echo "$file: opens without a comment"
    done
}

# Prints the words of "FILE:LINE:TEXT" that are paths of the project, as "FILE:LINE:PATH".
paths_in() {
    perl -ne 'BEGIN { $folders = shift }
        next unless /^([^:]*:\d+):(.*)/;
        my ($place, $text) = ($1, $2);
        while ($text =~ m{(?<![\w/.\$\}*-])(?:$folders)/[\w.*/-]*}g) {
            my $path = $& =~ s{[./]+$}{}r;
            print "$place:$path\n" unless $path =~ m{(^|/)(?!README\b)[A-Z][A-Z_]+\b};
        }' "${all_folders//[$' \n']/|}"
}

# Prints the lines "FILE:LINE:PATH" whose path does not exist.
missing() {
    local line path found
    while IFS= read -r line; do
        path=${line##*:}
        for found in '' .h .cpp .def .md .sh; do
            compgen -G "$path$found" >/dev/null && continue 2
        done
        echo "$line does not exist"
    done
}

# Prints the lines "Suite.Test" that are not names of tests.
missing_tests() {
    local name
    while IFS= read -r name; do
        grep -qrE "^TEST(_F|_P)?\(${name%%.*}, ${name#*.}\)" --include='*_test.cpp' tests ||
            echo "spec/promises.md: there is no test $name"
    done
}

# Prints the lines with marks of an unfinished merge below these folders, as "FILE:LINE:TEXT".
unmerged() { grep -rnIE --exclude-dir=node_modules '^(<{7}|\|{7}|>{7}) ' "$@"; }

# Reads lines of sources and prints the libraries that they load but package/late.txt does not name.
not_in_table() {
    grep -oE 'dlopen\("[^"]+"' | cut -d'"' -f2 | while IFS= read -r library; do
        grep -qwF -- "$library" package/late.txt || echo "package/late.txt does not name $library"
    done
}

list() { find "$@" -type f -not -path '*/node_modules/*'; }

# shellcheck disable=SC2086  # One word for each folder.
{
    mapfile -t sources < <(list $folders include examples -name '*.cpp'; list $folders -name '*.h')
    named=$(
        {
            list $all_folders \( -name '*.cpp' -o -name '*.h' -o -name '*.def' \) -print0 |
                xargs -0 grep -nHE '//' | sed -E 's#^([^:]*:[0-9]+:).*//#\1#'
            list $all_folders \( -name '*.sh' -o -name '*.cmake' -o -name CMakeLists.txt \) -print0 |
                xargs -0 grep -nHE '^ *#' CMakeLists.txt cascade tests/run
            list $all_folders -name '*.md' -print0 | xargs -0 grep -nH '' README.md
        } | paths_in | sort -u
    )
}
promised=$(grep -oE '`[A-Z][A-Za-z]+\.[A-Z*][A-Za-z]*`' spec/promises.md | tr -d '`' | sed 's/\*/[A-Za-z]*/')
broken=$(without_opening "${sources[@]}"; missing <<<"$named"; missing_tests <<<"$promised"
    unmerged $all_folders examples README.md CHANGELOG.md CONTRIBUTING.md CMakeLists.txt
    grep -rh 'dlopen("' --include='*.cpp' $folders | not_in_table)

# The check itself must work: these violations must be found, and nothing else.
made_up=$(mktemp -d)
trap 'rm -rf "$made_up"' EXIT
printf '#include "core/check.h"\n' >"$made_up/bad.cpp"
printf '// Checks.\n#include "core/check.h"\n' >"$made_up/good.cpp"
found=$(without_opening "$made_up"/*.cpp | grep -c 'bad\.cpp')
found+=$(printf 'a.h:1: %s\n' 'see core/no_such_file, core/check and core/check.h.' \
    'build/core/no, docs/nothing.md, lang/systems/NAME.cascade, ir/*.def' | paths_in | missing | grep -c .)
found+=$(printf 'Sources.%s\n' ThatIsNoTest | missing_tests | grep -c 'no test')
printf 'a\n%s HEAD\nb\n' '<<<<<<<' >"$made_up/half.md"
found+=$(unmerged "$made_up" | grep -c 'half\.md:2:')
found+=$(printf 'dlopen("libno_such.so.1", RTLD_LAZY)\n' | not_in_table | grep -c .)
if [ "$found" != 12111 ] || [ "$(grep -c . <<<"$promised")" -lt 5 ] || [ "${#sources[@]}" -lt 700 ] || [ "$(grep -c . <<<"$named")" -lt 300 ]; then
    echo "the check itself does not work ($found; ${#sources[@]} files, $(grep -c . <<<"$named") paths)"
    exit 1
fi
if [ -n "$broken" ]; then
    echo "comments are missing, names do not exist, or merges are unfinished:"
    echo "$broken"
    exit 1
fi
echo "${#sources[@]} files open with a comment; $(grep -c . <<<"$named") paths exist"
