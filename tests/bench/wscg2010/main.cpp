#include <cstdio>
#include "runtime/gl/context.h"
#include "tests/bench/wscg2010/measure/errors.h"
using namespace farcell; using namespace farcell::wscg;
Result<> go(const char*p){ FARCELL_ASSIGN(const Scene s, loadScene(p, UpAxis::z)); FARCELL_ASSIGN(GlContext c, GlContext::createHeadless());
 FARCELL_ASSIGN(const FullGeometry f, FullGeometry::create(s)); ErrorSettings e; FARCELL_ASSIGN(const ErrorResults r, measureErrors(s,f,e));
 for(auto&x:r.cells)printf("%d %zu\n",x.depth,x.occupied);
 std::string last; for(auto&x:r.rows){ if(x.variant==last)continue; last=x.variant; printf("%-34s",last.c_str()); for(double d:e.distances)printf(" %6.2f/%6.2f/%.2f%%",meanOver(r,s.name,last,d,toSingle),meanOver(r,s.name,last,d,toTruth),100*meanOver(r,s.name,last,d,holes)); printf("  st1 %6.2f\n",steepOver(r,s.name,last,1,toSingle));}
 return {};}
int main(int, char**a) { auto r=go(a[1]); if(!r)puts(r.error().message.c_str()); }
