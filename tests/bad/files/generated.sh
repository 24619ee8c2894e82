# Input too large or too odd to keep in a tree.
cd "$(mktemp -d)" || exit 1
say() { cut -c 1-160 | sed 's/^/    /'; }

echo '100000 nested brackets'
{ head -c 100000 /dev/zero | tr '\0' '('; echo 1; } >open.lag
qdot -q open.lag 2>&1 | say
{ head -c 100000 /dev/zero | tr '\0' '('; printf 1; head -c 100000 /dev/zero | tr '\0' ')'; echo; } >both.lag
qdot -q both.lag 2>&1 | say

echo '100000 nested functions'
{ printf 'coord x\ny = '; yes 'sin(' | head -n 100000 | tr -d '\n'; printf x
  head -c 100000 /dev/zero | tr '\0' ')'; echo; echo 'size(y)'; } >deep.lag
qdot -q deep.lag 2>&1 | say

echo 'a line of 10 MB: a sum'
{ printf 'size('; yes '1234+' | head -n 2000000 | tr -d '\n'; echo '1)'; } >long.lag
qdot -q long.lag 2>&1 | say

echo 'a line of 10 MB: a name'
{ head -c 10000000 /dev/zero | tr '\0' a; echo; } >name.lag
qdot -q name.lag 2>&1 | say

echo '1000 blocks, one in the other'
{ yes '{' | head -n 1000; echo 'a = 1'; yes '} for k = 1..1' | head -n 1000; echo a; } >blocks.lag
qdot -q blocks.lag 2>&1 | say

echo 'bytes of no text'
head -c 4096 /dev/zero >zero.lag
qdot -q zero.lag 2>&1 | say
gzip -nc blocks.lag >gzip.lag
qdot -q gzip.lag 2>&1 | head -n 1 | say

echo 'a directory'
mkdir folder.lag
qdot -q folder.lag 2>&1 | say

echo 'two scripts that include each other'
echo 'include "two.lag"' >one.lag
echo 'include "one.lag"' >two.lag
qdot -q one.lag 2>&1 | say

echo 'an empty script'
: >empty.lag
qdot -q empty.lag 2>&1 | say
rm -rf "$PWD"
