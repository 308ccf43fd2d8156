#!/usr/bin/env bash
# The prompt: from a pipe, and in a terminal with editing, history and completion.
set -u
rm -rf ./*

fail() {
    echo "repl: $*"
    cat out err
    exit 1
}
feed() { printf '%s\n' "$@" | "$CASCADE" repl >out 2>err || fail "exit status $?"; }
# Feeds input with a wrong line, after which the exit status must be 1.
feed_wrong() {
    printf '%s\n' "$@" | "$CASCADE" repl >out 2>err
    local status=$?
    [ "$status" = 1 ] || fail "exit status $status and not 1"
}
says() { grep -qF -- "$2" "$1" || fail "no '$2' in $1"; }

# A script typed line by line, a block over several lines, and several stages.
feed 'domain { grid: 16, 8 }' \
    'stage large: turing_spots {' '  iterations: 30' '}' \
    ':run 20' ':run 5' ':stages' ':run' ':quit' 'never: read'
says out "stage 'large', step 20 of 30"
says out "stage 'large', step 25 of 30"
says out 'large: turing_spots, step 25 of 30'
says out "stage 'large', step 30 of 30"
grep -q error err && fail "something was wrong"

# A wrong line changes nothing: the fields are the same as without the line.
feed 'domain { grid: 16, 8 }' 'stage s: turing_spots { iterations: 100 }' ':run 100' ':save right'
feed_wrong 'domain { grid: 16, 8 }' 'stage s: turing_spots { iterations: 100 }' ':run 60' \
    'stage t: turing_spotz { }' ':set s.kaa=1' ':show nobody' ':shwo' ':run x' ':load nowhere' \
    'stage t: turing_spots { iterations: 0 }' ':run 40' ':save wrong'
says err "prompt:3:10: error: "
says err "did you mean 'turing_spots'?"
says err "did you mean ':show'?"
says out "stage 's', step 60 of 100"
cmp right/s.b.npy wrong/s.b.npy || fail "a wrong line changed the fields"

# Changing a parameter during a run keeps the fields.
feed 'domain { grid: 16, 8 }' 'stage s: turing_spots { iterations: 100 }' ':run 60' \
    ':set s.ka=1/40' ':stages' ':run 40' ':save set'
says out 's: turing_spots, step 60 of 100'
cmp -s right/s.b.npy set/s.b.npy && fail ":set changed nothing"

# A parameter that is set twice is stored once.
feed 'domain { grid: 16, 8 }' 'stage s: turing_spots { iterations: 10 }' \
    ':set s.ka=1/40' ':set beta=12' ':set s.ka = 1/60' ':set s.ka=1/80' ':text'
[ "$(grep -c '^# :set' out)" = 2 ] || fail "settings that were replaced are kept"
says out '# :set beta=12'
says out '# :set s.ka=1/80'

# A run that is saved, loaded and continued has the same bits.
feed 'domain { grid: 16, 8 }' 'stage s: turing_spots { iterations: 100 }' ':run 60' ':save half'
feed ':load half' ':run 40' ':save loaded'
cmp right/s.b.npy loaded/s.b.npy || fail "loading lost something"
feed ':load half' ':init' ':run 100' ':save anew'
cmp right/s.b.npy anew/s.b.npy || fail ":init does not begin anew"

# A picture in a pipe: characters without escapes, two rows of cells in a line.
feed 'domain { grid: 16, 8 }' 'stage s: turing_spots { iterations: 10 }' ':run' ':show b' ':help' ':text'
[ "$(grep -cE '^[ .:=+*#%@-]{16}$' out)" = 4 ] || fail "no picture of 4 lines"
grep -q $'\x1b' out && fail "escapes in a pipe"
says out ':load FILE'
says out 'stage s: turing_spots { iterations: 10 }'

# A block that is typed again replaces the old one, and the run continues. An expression shows its value.
feed 'domain { grid: 16, 8 }' 'stage s: turing_spots { iterations: 100 }' ':run 60' 'mean(b over domain)' \
    'stage s: turing_spots { iterations: 80; ka: 1/30 }' ':stages' ':text' '2 + 3'
says out '4.0044 in all cells'
says out 's: turing_spots, step 60 of 80'
says out '5 in all cells'
[ "$(grep -c '^stage s' out)" = 1 ] || fail "the stage is there twice"

# :next, undo and redo; a session with all of these can be played.
feed 'domain { grid: 16, 8 }' 'stage s: turing_spots { iterations: 100 }' \
    'stage t: turing_spots { a: a; b: b; beta: beta; iterations: 50 }' ':run 60' ':paint b = b + 1' \
    ':undo' ':redo' ':next' ':run 10' ':save done.session' ':save played_once' ':goto s' ':stages' ':undo' \
    ':stages'
says out "stage 't', step 0 of 50"
says out 's: turing_spots, step 0 of 100'
says out 't: turing_spots, step 10 of 50'
feed ':load done.session' ':save played_again'
says out "stage 't', step 10 of 50"
cmp played_once/t.b.npy played_again/t.b.npy || fail "a session that is played again differs"
feed_wrong ':load done.session' ':goto nowhere' ':paint nobody = 1' ':paint' ':undo'
says err "no stage is called 'nowhere'"
says err "has nothing called 'nobody'"
says err 'nothing is left to undo'
"$CASCADE" run done.session -q --save run_again 2>err || fail "a session is not run"
cmp played_once/t.b.npy run_again/t.b.npy || fail "a session that is run differs"
"$CASCADE" check done.session >out 2>err || fail "a session has no script"
says out '2 stages'
printf 'cascade session 1\nname x\n' >broken.session
feed_wrong ':load broken.session'
says err 'broken.session: line 3 of the session'

# A picture contains the session: it can be drawn again, played and continued.
feed 'domain { grid: 16, 8 }' 'stage s: turing_spots { iterations: 100 }' \
    'stage t: turing_spots { a: a; b: b; beta: beta; iterations: 50 }' ':run 60' ':paint b = b + disc(0.5, 0.5, 0.2)' \
    ':run 10' ':set s.ka=1/60' ':next' ':run 7' ':show a' ':save live.png' ':save live' ':run 5' ':save later'
"$CASCADE" run live.png -o again.png --save again >out 2>err || fail "the picture of a session is not drawn again"
cmp live.png again.png || fail "the picture of a session is another one"
cmp live/t.a.npy again/t.a.npy || fail "the session of a picture gives other values"
says err 'live.png: playing its session, up to step 7 of stage 2'
feed ':load again.png' ':run 5' ':save gone_on'
says out "stage 't', step 7 of 50"
cmp later/t.a.npy gone_on/t.a.npy || fail "a picture's session does not go on"
"$CASCADE" run live.png -q --scale 2 -o twice.png || fail "a session is not drawn larger"
"$CASCADE" run live.png --set t.ka=1/50 -o other.png >out 2>err || fail "the script of a picture does not run"
says err 'its session is not played, because options change the script'
"$CASCADE" run live.png --frames film >out 2>err && fail "frames of a session"
says err 'only the end of a session can be written'
# The log of a session that began with a saved run does not grow it again.
feed ':load live' ':run 3' ':save resumed.png'
"$CASCADE" run resumed.png -o own.png >out 2>err || fail "the script of a picture does not run"
grep -q 'playing' err && fail "a session without its beginning is played"

# The script can be saved, unless the run also depends on :set.
feed 'domain { grid: 16, 8 }' 'stage s: turing_spots { iterations: 10 }' ':save mine.cascade'
grep -q '^stage s: turing_spots { iterations: 10 }$' mine.cascade || fail "the script is not saved"
feed_wrong ':load mine.cascade' ':set ka=1/30' ':save other.cascade'
says err "that ':set' changed are not in the text"
[ -e other.cascade ] && fail "another script was saved than was run"
# The ending of a name, in upper or lower case, chooses the kind of file. A name with another file's ending is refused,
# so that no folder gets such a name.
feed 'domain { grid: 16, 8 }' 'stage s: turing_spots { iterations: 10 }' ':save large.PNG'
[ -f large.PNG ] || fail "NAME.PNG is not a picture"
for name in photo.JPG anim.gif table.csv; do
    feed_wrong 'domain { grid: 16, 8 }' 'stage s: turing_spots { iterations: 10 }' ":save $name"
    says err "':save' cannot write a file that ends with"
    [ -e "$name" ] && fail "a folder is called $name"
done

# A saved run contains painted values.
feed 'domain { grid: 16, 8 }' 'stage s: turing_spots { iterations: 100 }' ':run 20' ':paint beta = 13' \
    ':save painted' ':run 30' ':save on'
feed ':load painted' ':run 30' ':save resumed'
cmp on/s.b.npy resumed/s.b.npy || fail "a painted parameter is lost"

# Remarks on the result are shown, and that no steps are left.
feed 'domain { grid: 16, 8 }' 'stage s: gray_scott { u: 1; v: 0; iterations: 50 }' ':run' ':show v' ':run' \
    ':set s.feed=0.05'
says err "stage 's' ended uniform (u = 1, v = 0), with all cells the same"
says out '0 in all cells'
[ "$(grep -c "type ':init' to begin again" err)" = 2 ] || fail "not told that all is over"

# Commands of the program for the script so far, and help for each.
feed 'domain { grid: 16, 8 }' 'stage s: turing_spots { iterations: 100 }' ':run' ':features' ':check' ':check --dump equations' \
    ':sweep --vary s.ka=1/60,1/80 -o swept -q' ':systems brusselator' ':help run' ':help check' ':help :systems'
says out 'wavelength'
says out 'prompt: no errors'
says out '∂a/∂t'
[ -e swept/sheet.png ] || fail "no sheet of the script so far"
says out 'brusselator'
says out 'take N steps'
says out 'Usage: cascade check'
says out 'Usage: cascade systems'
feed_wrong ':check' ':bench --nonsense' ':help nothing'
says err 'there is no script yet'
says err "there is no command ':nothing'"

# Cells that crawl: strokes change and remove cells, and a picture grows them again.
feed_wrong "cells spot: scales { tone: random(0.5, 0.3); tone' = 0; soft: 1; p' += push(soft) }" \
    'domain { surface: sphere; cells: 200 }' 'stage s: spot { founders: 4; r: 0.08; duration: 8 }' \
    ':run 60' ':set soft=2' ':paint tone=if(y > 0.5, 1, tone)' ':paint remove=y > 0.9' ':undo' ':redo' \
    ':run 5' ':save crawl.png' ':save crawl.session' ':features' ':paint p.x=1'
says out 'births, 0 deaths'
says err 'cells that crawl have no rows and columns'
says err "nothing called 'p.x'"
"$CASCADE" run -q crawl.png -o again.png >/dev/null 2>&1 || fail "the picture of cells does not run"
cmp -s crawl.png again.png || fail "the picture of cells is not itself again"
feed ':load crawl.session' ':save played.session'
cmp -s crawl.session played.session || fail "a session of cells is another one when it is played"

# Words of other prompts.
feed 'help' && says out ':load FILE'
feed '?' && says out ':load FILE'
feed 'exit' 'stage s: nonsense'

# The end of the pipe also ends a block, with the parser's message.
feed_wrong 'stage s: turing_spots {'
says err 'error:'

command -v python3 >/dev/null || exit 0
# The library for editing lines does not free its history.
export ASAN_OPTIONS="${ASAN_OPTIONS:-}:detect_leaks=0"
XDG_STATE_HOME=$PWD/state python3 - "$CASCADE" <<'END' || { echo "repl: in a terminal"; exit 1; }
import os, pty, select, sys, time

def start():
    pid, terminal = pty.fork()
    if pid == 0:
        os.environ["TERM"] = "xterm"
        os.execv(sys.argv[1], ["cascade", "repl"])
    return pid, terminal

pid, terminal = start()

def expect(words, seconds=60):
    seen, end = b"", time.time() + seconds
    while words not in seen:
        ready, _, _ = select.select([terminal], [], [], max(0, end - time.time()))
        if not ready:
            sys.exit(f"no {words!r} in {seen!r}")
        seen += os.read(terminal, 65536)
    return seen

def type_in(text):
    os.write(terminal, text)

expect(b"1> ")
type_in(b"domain { grid: 16, 8; precis\t: single }\r")
expect(b"2> ")
type_in(b"stage s: turing_spots {\r")
expect(b"3| ")
type_in(b"\x03")                                # Ctrl-C drops the block, not the program.
expect(b"2> ")
type_in(b"stage s: turi\t{ iterations: 100000000 }\r")
expect(b"3> ")
type_in(b":sta\t\r")
expect(b"step 0 of 100000000")
type_in(b":run\r")
expect("▕".encode())                            # a bar,
expect("▀".encode())                            # and the pattern while it grows,
expect(b"\x1b[4A\x1b[J")                        # again and again in its place.
type_in(b"\x03")                                # Ctrl-C stops the run,
expect("▀".encode())                            # which is shown,
type_in(b":stages\r")                           # and the prompt goes on.
expect(b"of 100000000")
type_in(b":quit\r")
_, status = os.waitpid(pid, 0)
file = os.environ["XDG_STATE_HOME"] + "/cascade/history"
history = open(file).read()
if status != 0 or "stages" not in history:
    sys.exit(f"status {status}, history {history!r}")

# If the terminal is closed or the program is killed, no typed line is lost.
for number, signal in enumerate(["closed", 9]):
    pid, terminal = start()
    expect(b"1> ")
    type_in(b"domain { grid: 1%d, 8 }\r" % number)
    expect(b"2> ")
    if signal == "closed":
        os.close(terminal)
    else:
        os.kill(pid, signal)
    os.waitpid(pid, 0)
    kept = open(file).read()
    if not kept.startswith(history) or len(kept) <= len(history):
        sys.exit(f"{signal}: the history was {history!r} and is {kept!r}")
    history = kept
pid, terminal = start()
expect(b"1> ")
type_in(b"\x1b[A")                              # Up: the line that was typed last.
expect(b"grid: 11, 8")
type_in(b"\x03\x04")
os.waitpid(pid, 0)

# Pictures in pixels, if the terminal answers that it can show them.
import base64, fcntl, re, struct, termios

def picture(answers, **environment):
    global pid, terminal
    pid, terminal = pty.fork()
    if pid == 0:
        for name in ("TMUX", "STY", "CASCADE_PICTURES", "TERM_PROGRAM"):
            os.environ.pop(name, None)
        os.environ.update({"TERM": "xterm", **environment})
        fcntl.ioctl(0, termios.TIOCSWINSZ, struct.pack("HHHH", 24, 80, 0, 0))
        os.execv(sys.argv[1], ["cascade", "repl"])
    asked = b""
    if answers is not None:
        asked = expect(b"\x1b[c")
        type_in(answers)
    expect(b"1> ")
    type_in(b"domain { grid: 16, 8 }\r")
    expect(b"2> ")
    type_in(b"stage s: turing_spots { iterations: 10 }\r")
    expect(b"3> ")
    type_in(b":show b\r")
    shown = expect(b"3> ")
    type_in(b":quit\r")
    os.waitpid(pid, 0)
    if b"\x1b[?62" in shown or b"^[" in shown:
        sys.exit(f"answers are echoed: {shown!r}")
    return asked, shown

def check(holds, about, shown):
    if not holds:
        sys.exit(f"{about}: {shown!r}")

kitty = b"\x1b_Gi=31;OK\x1b\\\x1b[6;16;8t\x1b[?62;4c"
asked, shown = picture(kitty)
check(b"a=q" in asked, "kitty's protocol is not asked for", asked)
png = base64.b64decode(b"".join(re.findall(rb"\x1b_G[^;]*;([^\x1b]*)\x1b", shown)))
check(png[:4] == b"\x89PNG" and struct.unpack(">II", png[16:24]) == (128, 64), "no PNG of kitty", shown)
check("▀".encode() not in shown, "half blocks, too", shown)
asked, shown = picture(b"\x1b[?62;4;22c")
check(b"\x1bP0;1;0q\"1;1;160;80#" in shown, "no sixels", shown)
asked, shown = picture(b"\x1b[?62;4c", TERM="tmux-256color", TMUX="/tmp/tmux,1,0")
check(b"\x1b_G" not in asked, "tmux is asked for kitty's protocol", asked)
check(b"\x1bP" in shown, "no sixels in tmux", shown)
asked, shown = picture(b"\x1b[?62;22c")
check("▀".encode() in shown and b"\x1bP" not in shown, "pixels in a terminal without", shown)
asked, shown = picture(None)                    # The terminal does not answer.
check("▀".encode() in shown, "no picture in a silent terminal", shown)
asked, shown = picture(None, CASCADE_PICTURES="characters")
check(b"\x1b[c" not in shown and "▀".encode() in shown, "characters are not forced", shown)
asked, shown = picture(b"\x1b[?62;22c", CASCADE_PICTURES="sixel")
check(b"\x1b_G" not in asked and b"\x1bP" in shown, "sixels are not forced", shown)

# During growth, kitty's pictures replace each other by their number, and are removed at the end.
pid, terminal = pty.fork()
if pid == 0:
    os.environ.update({"TERM": "xterm", "TMUX": "", "STY": ""})
    os.execv(sys.argv[1], ["cascade", "repl"])
expect(b"\x1b[c")
type_in(kitty)
expect(b"1> ")
type_in(b"stage s: turing_spots { iterations: 100000000 }\r")
expect(b"2> ")
type_in(b":run\r")
number = re.search(rb"q=2,(i=\d+),", expect(b"m=0;"))[1]
expect(b"\x1b_Ga=d,d=I," + number)
type_in(b"\x03")
expect(b"2> ")
type_in(b":quit\r")
os.waitpid(pid, 0)

# `cascade view` of a picture begins at the end of its session.
import signal, socket, subprocess

class Page:
    def __init__(self, script):
        self.server = subprocess.Popen([sys.argv[1], "view", script, "--no-browser"],
                                       stdout=subprocess.PIPE, stderr=subprocess.PIPE)
        port, token = re.search(rb":(\d+)/#token=(\w+)", self.server.stdout.readline()).groups()
        self.socket = socket.create_connection(("127.0.0.1", int(port)), timeout=60)
        self.socket.sendall(
            b"GET /session?token=%s HTTP/1.1\r\nHost: 127.0.0.1:%s\r\nOrigin: http://127.0.0.1:%s\r\n"
            b"Upgrade: websocket\r\nConnection: Upgrade\r\nSec-WebSocket-Version: 13\r\n"
            b"Sec-WebSocket-Key: AAAAAAAAAAAAAAAAAAAAAA==\r\n\r\n" % (token, port, port))
        self.told = b""
        while not self.told.endswith(b"\r\n\r\n"):
            self.told += self.socket.recv(1)

    def ask(self, words, answer):
        self.socket.sendall(bytes([0x81, 0x80 | len(words)]) + bytes(4) + words)
        while not re.search(answer, self.told):
            more = self.socket.recv(65536)
            check(more, f"no {answer!r} from the page", self.told)
            self.told += more

    def end(self, number):
        self.server.send_signal(number)
        return self.server.communicate()[1]

page = Page("live.png")
page.ask(b'{"do": "next_snapshot"}', rb'"steps":7\b')
page.end(signal.SIGINT)

# However a session ends, its file contains all changes, unless the user ends the session.
def sessions():
    return sorted(name for name in os.listdir() if ".unsaved" in name and name.endswith(".session"))

open("kept.cascade", "w").write("domain { grid: 16, 8 }\nstage s: turing_spots { iterations: 50 }\n")
check(not sessions(), "files of sessions that the user ended", sessions())
for number, kept in (signal.SIGINT, 0), (signal.SIGKILL, 1), (signal.SIGTERM, 2), (signal.SIGINT, 2):
    page = Page("kept.cascade")
    page.ask(b'{"do":"step","count":9,"id":1}', rb'"id":1\b')
    while not re.search(rb'"steps":9\b', page.told):
        page.told = b""
        page.ask(b'{"do":"next_snapshot"}', rb'"steps":\d+\D')
    page.ask(b'{"do":"paint","item":"b","expression":"b+1","id":2}', rb'"id":2\b')
    page.ask(b'{"do":"set","name":"s.ka","expression":"1/%d","id":3}' % (30 + kept), rb'"id":3\b')
    page.ask(b'{"do":"undo","id":4}', rb'"id":4\b')
    page.ask(b'{"do":"set","name":"s.ka","expression":"1/%d","id":5}' % (40 + kept), rb'"id":5\b')
    said = page.end(number)
    check(len(sessions()) == kept, f"signal {number}", sessions())
    check(kept == 0 or number == signal.SIGKILL or b"kept.unsaved.session holds a session" in said,
          "nothing is said of the file that was left", said)
check(sessions() == ["kept.unsaved-2.session", "kept.unsaved.session"], "other names", sessions())
done = "cascade session 1\nname kept.cascade\noptions {}\nscript 3\n" + open("kept.cascade").read() + \
    "\nat 1 9\npaint b=b+1\nset s.ka=1/41\nend 1 9\n"
open("done.session", "w").write(done)
for name in "done", "kept.unsaved":
    subprocess.run([sys.argv[1], "run", name + ".session", "-q", "-o", "played.png", "--save", name], check=True)
same = subprocess.run(["cmp", "done/s.b.npy", "kept.unsaved/s.b.npy"]).returncode == 0
check(same, "the file of the killed session grows another pattern", open("kept.unsaved.session").read())

pid, terminal = start()
expect(b"1> ")
type_in(b"stage s: turing_spots { iterations: 100 }\r")
expect(b"2> ")
type_in(b":run 7\r")
expect(b"' continues it")                      # The message that names the session's file.
type_in(b":paint b=b+1\r")
type_in(b":set s.ka=1/70\r")
type_in(b":stages\r")
expect(b"step 7 of")
os.kill(pid, 9)
os.waitpid(pid, 0)
told = subprocess.run([sys.argv[1], "repl", "prompt.unsaved.session"], input=b":stages\n:text\n", capture_output=True).stdout
check(b"step 7 of 100" in told and b"# :set s.ka=1/70" in told, "the prompt's session is lost", told)
END
echo "repl: right"
