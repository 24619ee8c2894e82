# Where the past is not unique a run back in time ends there, in words.
scene="coord y; param g = 10, k = 1; particle b mass 1 at y; potential g*y"
try()
{
    qdot -q -e "$scene; $1" 2>&1 | grep -E '^(notice|[a-z0-9]*: t|.*error:)' | sed 's/^run1.*failed: //; s/-e:[0-9:]* //'
}
echo '--- at rest on a contact'
try "event h: y = 1 falling then y' = -y'/2; start y = 1; run 9..0"
try "event h: y = 1 falling then y' = -y'/2, k = k + 1; start y = 1; run 9..0"
echo '--- at rest on a wall of two sides'
try "event h: y = 1 then y' = -y'/2; start y = 1; run 9..0"
echo '--- a contact that a force has ended'
try "force if(t > 3, 12, 0) on y; event h: y = 0 falling then y' = -y'/2; start y = 1; run 0..5 as a; start a; run 5..0 as b"
echo '--- a parameter, a speed and a place that are forgotten'
try "event s: t = 1 then g = 0; start y = 2; run 3..0"
try "event h: y = 0 falling then y' = 0; start y = 2, y' = 8; run 3..0"
try "event h: y = 1 rising then y = 0, g = 5; start y = 2; run 3..0"
try "event h: y = g rising then y = 0, g = 5; start y = 2; run 3..0"
try "event h: y = 0 falling then y' = abs(y'); start y = 2, y' = 8; run 3..0"
echo '--- a place that the event itself says'
try "event h: y = 1 rising then y = 0; start y = 1/2, y' = 3; run 0..-1/2 as a; check value(y, -1/2) == 1/4 within 1e-14"
echo '--- no motion comes here'
try "event h: y = 0 falling then y' = -y'/2; start y = -1, y' = -8; run 0..-1"
echo '--- undone, where the motion could have crossed without it'
try "event h: y = 0 falling then y' = -y'/2; start y = 1, y' = 1; run 0..-1"
try "event h: y = 0 then y' = -y'/2; start y = 1, y' = 1; run 0..-1"
echo '--- a crossing the other way is none of the event'
try "event h: y = 0 rising then g = g/2; start y = -2, y' = -3; run 0..-1; check value(g, -1) == 10 within 0"
