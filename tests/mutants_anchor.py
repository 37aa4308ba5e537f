"""Anchors the mutants of a list by function name and a short token: reads tests/mutants*.txt and tribox.h, and for
each mutant that is found exactly once writes "in FUNCTION" and the shortest text around the change that is unique
there. Mutants already anchored, stale ones and those outside of functions stay as they are. Run from the
repository's root: python3 tests/mutants_anchor.py tests/mutants.txt
"""
import re
import subprocess
import sys
import os

header = open('tribox.h').read()
WORDS = re.compile(r'\s+')


def regions():
    """name -> list of (from, to) of its definitions, as tests/mutate.awk finds them"""
    found, at, open_, name = {}, 0, 0, None
    for line in header.split('\n'):
        if open_ == 0:
            macro = re.match(r'#define (\w+)[ (]', line)
            head = re.match(r'[A-Za-z].*?(?:^|[ *])((?:tribox|tbx)_\w+)\(', line)
            if macro:
                begin, open_, name = at, 3, macro.group(1)
            elif head:
                begin, open_, name = at, 1, head.group(1)
        if open_ == 1 and re.search(r';[ \t]*$', line):
            open_ = 0
        elif open_ == 1 and line == '{':
            open_ = 2
        elif (open_ == 2 and line == '}') or (open_ == 3 and not line.endswith('\\')):
            found.setdefault(name, []).append((begin, at + len(line)))
            open_ = 0
        at += len(line) + 1
    return found


def pattern(text):
    return r'\s+'.join(re.escape(w) for w in text.split())


def occurrences(text, ranges):
    return [m for a, b in ranges for m in re.finditer('(?=(' + pattern(text) + '))', header[a:b])]


def apply(old, new, inside):
    env = dict(os.environ, OLD=old, NEW=new, IN=inside)
    done = subprocess.run(['awk', '-f', 'tests/mutate.awk', 'tribox.h'], env=env, capture_output=True, text=True)
    return done.stdout if done.returncode == 0 else None


def tokens(text):
    return re.findall(r'\s+|\w+|[^\w\s]', text)


def shorten(old, new, ranges, least=10, pairs=('()', '[]', '{}')):
    """the shortest pair of texts, grown around the change token by token, whose old one is unique"""
    a, b = tokens(old), tokens(new)
    head = 0
    while head < min(len(a), len(b)) and a[head] == b[head]:
        head += 1
    tail = 0
    while tail < min(len(a), len(b)) - head and a[-1 - tail] == b[-1 - tail]:
        tail += 1
    for grow in range(len(a) + 1):
        for left in range(grow + 1):
            first, last = max(0, head - left), min(len(a), len(a) - tail + grow - left)
            part = ''.join(a[first:last])
            changed = ''.join(b[first:len(b) - (len(a) - last)])
            if not part.strip() or part != part.strip() or any(part.count(o) != part.count(c) for o, c in pairs):
                continue
            if len(part) < least:
                continue
            if len(occurrences(part, ranges)) == 1 and len(part.split()) and part.strip() != changed.strip():
                return part, changed
    return shorten(old, new, ranges, 1, ()) if pairs else None


def main(path):
    names = regions()
    out, block = [], {'old': [], 'new': [], 'in': None, 'raw': []}
    counts = {'anchored': 0, 'kept': 0, 'stale': 0}

    def finish():
        raw, old, new = block['raw'], '\n'.join(block['old']), '\n'.join(block['new'])
        if old and not block['in']:
            whole = apply(old, new, '')
            if whole is None:
                counts['stale'] += 1
            else:
                m = re.search(pattern(old), header)
                owner = [n for n, rs in names.items() for a, b in rs if a <= m.start() and m.end() <= b + 1]
                short = shorten(old, new, names[owner[0]]) if owner else None
                flat = short and tuple(re.sub(r'\s*\n\s*', ' ', t) for t in short)
                squeeze = lambda t: WORDS.sub(' ', t)
                after = flat and apply(flat[0], flat[1], owner[0])
                if after is not None and flat and squeeze(after) == squeeze(whole):
                    counts['anchored'] += 1
                    raw = [r for r in raw if not re.match(r'[-+]( |$)', r)]
                    raw += ['in ' + owner[0], '- ' + flat[0], '+ ' + flat[1] if flat[1] else '+']
                else:
                    counts['kept'] += 1
        out.extend(raw)
        block.update(old=[], new=[], raw=[])
        block['in'] = None

    for line in open(path).read().split('\n'):
        if line.startswith('# ') or line.startswith('@ ') or line == '':
            finish()
        if line.startswith('- '):
            block['old'].append(line[2:])
        elif line.startswith('+ '):
            block['new'].append(line[2:])
        elif line.startswith('in '):
            block['in'] = line[3:]
        block['raw'].append(line)
    finish()
    open(path, 'w').write('\n'.join(out))
    print(path, counts)


for name in sys.argv[1:]:
    main(name)
