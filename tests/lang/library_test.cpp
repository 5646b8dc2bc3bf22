// SPDX-License-Identifier: Apache-2.0
// The files of library/ against those that POV-Ray 3.7.0.10 comes with. Each row was run once by
//   povray -D +Irow.pov +W8 +H8 -F +GDrow.txt
// behind kPrelude and `#include "FILE.inc"`; the second column is what it wrote, lines joined by
// '|'. To renew a row, run it through POV-Ray again, not through Vestige. Text is compared exactly.
#include "support/catch.h"

#include <cmath>
#include <cstdio>
#include <cstdlib>

#include "tests/lang/povray_rows.h"
#include "tests/lang/schemas.h"

namespace vestige::lang::test {
namespace {

// Names that POV-Ray's files do not use: a macro's body is read with the caller's names.
const char* const kPrelude = R"(
#macro ShowN(ZV) #debug concat("@",str(ZV,0,12),"\n") #end
#macro ShowV(ZV) #debug concat("@",vstr(3,ZV,",",0,9),"\n") #end
#macro ShowC(ZV) #debug concat("@",vstr(5,ZV,",",0,9),"\n") #end
#macro ShowS(ZV) #debug concat("@",ZV,"\n") #end
)";

struct Row {
  const char* text;
  const char* expected;
};

// clang-format off
const Row kMath[] = {
    {"ShowN(even(4)) ShowN(even(3)) ShowN(even(0)) ShowN(even(-2)) ShowN(even(-3)) ShowN(even(2.5)) ShowN(even(3.7)) ShowN(odd(4)) ShowN(odd(3)) ShowN(odd(0)) ShowN(odd(-3)) ShowN(odd(-2)) ShowN(odd(2.5)) ShowN(odd(3.7)) ShowN(odd(1.0000000001)) ShowN(even(1e15))", "1.000000000000|0.000000000000|1.000000000000|1.000000000000|0.000000000000|0.000000000000|0.000000000000|0.000000000000|1.000000000000|0.000000000000|1.000000000000|0.000000000000|1.000000000000|1.000000000000|1.000000000000|1.000000000000"},
    {"ShowN(Interpolate(0.5,0,1,0,10,1)) ShowN(Interpolate(0,-2,2,0,10,1)) ShowN(Interpolate(0.5,0,1,0,10,2)) ShowN(Interpolate(0.25,0,1,0,10,0)) ShowN(Interpolate(0.25,0,1,2,10,-2)) ShowN(Interpolate(2,0,1,2,10,1)) ShowN(Interpolate(-1,0,1,2,10,2)) ShowN(Interpolate(2,0,1,2,10,0)) ShowN(Interpolate(0.3,0,1,2,10,-0.5)) ShowN(Interpolate(0.3,0,1,2,10,0.5)) ShowN(Interpolate(3,1,5,7,-2,3))ShowN(Interpolate(3,1,5,7,-2,-3))", "5.000000000000|5.000000000000|2.500000000000|1.464466094067|130.000000000000|18.000000000000|10.000000000000|2.000000000000|16.605934866804|6.381780460041|5.875000000000|-65.000000000000"},
    {"ShowN(Interpolate(0,1,1,0,10,1))", "inf"},
    {"ShowN(Interpolate(-1,0,1,2,10,0.5))", "-nan"},
    {"ShowN(Interpolate(0,0,1,2,10,-2))", "inf"},
    {"ShowN(Interpolate(1,0,1,2,10,-2))", "10.000000000000"},
    {"ShowN(Mean(array[3]{1,2,4}))", "2.333333333333"},
    {"#declare A=array[3]{1,2,4} ShowN(Mean(A))", "2.333333333333"},
    {"#declare A=array[2]{<1,2,3>,<4,6,8>} ShowV(Mean(A))", "2.500000000,4.000000000,5.500000000"},
    {"#declare A=array[1]{5} ShowN(Mean(A))", "5.000000000000"},
    {"#declare A=array[4]{1,2,4,-3} ShowN(Std_Dev(A,Mean(A))) ShowN(Std_Dev(A,0))", "2.549509756796|2.738612787526"},
    {"#declare A=array[1]{5} ShowN(Std_Dev(A,5)) ShowN(Std_Dev(A,3))", "0.000000000000|2.000000000000"},
    {"#declare A=array[5]{1,2,4,-3,9} GetStats(A) ShowN(dimension_size(StatisticsArray,1)) #for(I,0,4) ShowN(StatisticsArray[I]) #end", "5.000000000000|5.000000000000|2.600000000000|-3.000000000000|9.000000000000|3.929376540878"},
    {"#declare A=array[1]{5} GetStats(A) #for(I,0,4) ShowN(StatisticsArray[I]) #end", "1.000000000000|5.000000000000|5.000000000000|5.000000000000|0.000000000000"},
    {"ShowN(sind(30)) ShowN(cosd(60)) ShowN(tand(45)) ShowN(asind(1)) ShowN(acosd(0.5)) ShowN(atand(1)) ShowN(atan2d(1,-1)) ShowN(tand(90)) ShowN(atan2d(0,0)) ShowN(atan2d(-0.0,-1))", "0.500000000000|0.500000000000|1.000000000000|90.000000000000|60.000000000000|45.000000000000|135.000000000000|16331239353195370.000000000000|0.000000000000|-180.000000000000"},
    {"ShowN(max3(1,2,3)) ShowN(max3(3,1,2)) ShowN(max3(1,3,2)) ShowN(min3(1,2,3)) ShowN(min3(3,1,2)) ShowN(min3(2,3,1)) ShowN(f_sqr(-3)) ShowN(sgn(-2)) ShowN(sgn(0)) ShowN(sgn(3)) ShowN(sgn(1e-12)) ShowN(sgn(-1e-300))", "3.000000000000|3.000000000000|3.000000000000|1.000000000000|1.000000000000|1.000000000000|9.000000000000|-1.000000000000|0.000000000000|1.000000000000|1.000000000000|-1.000000000000"},
    {"ShowN(clip(5,1,3)) ShowN(clip(-5,1,3)) ShowN(clip(2,1,3)) ShowN(clip(2,3,1)) ShowN(clip(0,3,1)) ShowN(clip(5,3,1)) ShowN(clip(1,1,1)) ShowN(clip(0,1,1))", "3.000000000000|1.000000000000|2.000000000000|1.000000000000|1.000000000000|1.000000000000|1.000000000000|1.000000000000"},
    {"ShowN(clamp(5,1,3)) ShowN(clamp(-5,1,3)) ShowN(clamp(2,1,3)) ShowN(clamp(3,1,3)) ShowN(clamp(1,1,3)) ShowN(clamp(3.5,1,3)) ShowN(clamp(0.5,1,3)) ShowN(clamp(-0.25,0,1)) ShowN(clamp(2,3,1)) ShowN(clamp(7.25,3,1)) ShowN(clamp(-7.25,3,1)) ShowN(clamp(-1,1,3)) ShowN(clamp(-3,0,1.5))", "1.000000000000|1.000000000000|2.000000000000|1.000000000000|1.000000000000|1.500000000000|2.500000000000|0.750000000000|0.000000000000|3.250000000000|0.750000000000|1.000000000000|0.000000000000"},
    {"ShowN(clamp(2,1,1))", "-nan"},
    {"ShowN(clamp(1,1,1))", "-nan"},
    {"ShowN(adj_range(0.25,2,6)) ShowN(adj_range(2,2,6)) ShowN(adj_range(-1,6,2)) ShowN(adj_range2(3,2,6,10,20)) ShowN(adj_range2(3,6,2,10,20)) ShowN(adj_range2(30,2,6,10,20)) ShowN(adj_range2(30,2,6,20,10))", "3.000000000000|10.000000000000|10.000000000000|12.500000000000|17.500000000000|80.000000000000|-50.000000000000"},
    {"ShowN(adj_range2(30,2,2,20,10))", "-inf"},
    {"ShowV(VPow(<1,-2,3>,0.5))", "1.000000000,-nan,1.732050808"},
    {"ShowN(VSqr(3))", "9.000000000000"},
    {"ShowC(VSqr(<1,2,3,4,5>))", "1.000000000,4.000000000,9.000000000,16.000000000,25.000000000"},
    {"ShowC(VNormalize5D(<0,0,0,0,0>))", "inf,inf,inf,inf,inf"},
    {"ShowN(VCos_Angle(<1,0,0>,<1,1,0>)) ShowN(VAngle(x,y)) ShowN(VAngleD(x,x+y)) ShowN(VAngle(x,x)) ShowN(VAngle(x,-x)) ShowN(VAngle(<1,2,3>,<1,2,3>*7)) ShowN(VAngleD(<1,2,3>,-<1,2,3>*7))", "0.707106781187|1.570796326795|45.000000000000|0.000000000000|3.141592653590|0.000000000000|180.000000000000"},
    {"ShowN(VAngle(0,x))", "1.570796326795"},
    {"ShowN(VAngleD(<0,0,0>,x))", "90.000000000000"},
    {"ShowN(VCos_Angle(<0,0,0>,x))", "0.000000000000"},
    {"ShowN(VRotation(x,y,z)) ShowN(VRotation(y,x,z)) ShowN(VRotationD(x,y,z)) ShowN(VRotationD(y,x,z)) ShowN(VRotationD(y,x,<0,0,0>)) ShowN(VRotationD(x,y,-z)) ShowN(VRotationD(x,x,z)) ShowN(VRotationD(x,-x,z)) ShowN(VRotationD(<1,2,3>,<-2,1,5>,<1,1,1>)) ShowN(VRotation(x,-x,z)) ShowN(VRotation(2*x,3*y+x,z*4))", "1.570796326795|-1.570796326795|90.000000000000|-90.000000000000|90.000000000000|-90.000000000000|0.000000000000|180.000000000000|42.951978120924|3.141592653590|1.249045772398"},
    {"ShowN(VRotation(0,x,z))", "1.570796326795"},
    {"ShowN(VDist(<1,2,3>,<4,6,3>)) ShowN(VDist(0,<3,4,0>)) ShowV(VPerp_To_Vector(x)) ShowV(VPerp_To_Vector(y)) ShowV(VPerp_To_Vector(z)) ShowV(VPerp_To_Vector(<1,2,3>)) ShowV(VPerp_To_Vector(<3,2,1>)) ShowV(VPerp_To_Vector(<1,-3,2>)) ShowV(VPerp_To_Vector(<-2,1,1>)) ShowV(VPerp_To_Vector(<1,1,1>)) ShowV(VPerp_To_Vector(-y)) ShowV(VPerp_To_Vector(5*z)) ShowV(VPerp_To_Vector(<1,1,0>)) ShowV(VPerp_To_Vector(<0,1,1>)) ShowV(VPerp_To_Vector(<1,0,1>)) ShowV(VPerp_To_Vector(<2,2,1>)) ShowV(VPerp_To_Vector(<1,2,2>)) ShowV(VPerp_To_Vector(<2,1,2>)) ShowV(VPerp_To_Vector(-<2,1,2>)) ShowV(VPerp_To_Vector(<0.1,0.02,0.3>))", "5.000000000000|5.000000000000|0.000000000,-1.000000000,0.000000000|1.000000000,0.000000000,0.000000000|-1.000000000,0.000000000,0.000000000|0.000000000,0.832050294,-0.554700196|0.554700196,-0.832050294,0.000000000|-0.000000000,0.554700196,0.832050294|0.447213595,0.894427191,-0.000000000|0.707106781,-0.707106781,0.000000000|-1.000000000,0.000000000,0.000000000|-1.000000000,0.000000000,0.000000000|0.707106781,-0.707106781,0.000000000|0.000000000,0.707106781,-0.707106781|-0.707106781,0.000000000,0.707106781|0.707106781,-0.707106781,0.000000000|0.000000000,0.707106781,-0.707106781|-0.707106781,0.000000000,0.707106781|0.707106781,0.000000000,-0.707106781|-0.948683298,0.000000000,0.316227766"},
    {"ShowV(VPerp_To_Vector(<0,0,0>))", "0.000000000,0.000000000,0.000000000"},
    {"ShowV(VPerp_To_Plane(x,y)) ShowV(VPerp_To_Plane(<1,2,3>,<3,-2,1>)) ShowV(VPerp_Adjust(<1,2,3>,y)) ShowV(VPerp_Adjust(<1,2,3>,<1,1,0>)) ShowV(VPerp_Adjust(<1,2,3>,2*z)) ShowV(VProject_Plane(<1,2,3>,y)) ShowV(VProject_Plane(<1,2,3>,2*y)) ShowV(VProject_Plane(<1,2,3>,<1,1,1>)) ShowV(VProject_Axis(<1,2,3>,y)) ShowV(VProject_Axis(<1,2,3>,<1,1,1>)) ShowV(VProject_Axis(<1,2,3>,3*z))", "0.000000000,0.000000000,1.000000000|0.577350269,0.577350269,-0.577350269|0.316227766,-0.000000000,0.948683298|-0.162221421,0.162221421,0.973328527|0.447213595,0.894427191,-0.000000000|1.000000000,0.000000000,3.000000000|1.000000000,0.000000000,3.000000000|-1.000000000,-0.000000000,1.000000000|0.000000000,2.000000000,0.000000000|2.000000000,2.000000000,2.000000000|0.000000000,0.000000000,3.000000000"},
    {"ShowV(VPerp_To_Plane(x,x))", "0.000000000,0.000000000,0.000000000"},
    {"ShowV(VPerp_Adjust(x,x))", "0.000000000,0.000000000,0.000000000"},
    {"ShowV(VProject_Plane(<1,2,3>,<0,0,0>))", "1.000000000,2.000000000,3.000000000"},
    {"ShowV(VProject_Axis(<1,2,3>,<0,0,0>))", "inf,inf,inf"},
    {"ShowV(VProject_Plane(y,y))", "0.000000000,0.000000000,0.000000000"},
    {"ShowV(VPerp_Adjust(<1,2,3>,<0,0,0>))", "0.000000000,0.000000000,0.000000000"},
    {"ShowV(VWith_Len(<0,0,0>,10))", "0.000000000,0.000000000,0.000000000"},
    {"ShowN(__Gradient_Fn_Accuracy_) SetGradientAccuracy(0.01) ShowN(__Gradient_Fn_Accuracy_)", "0.001000000000|0.010000000000"},
    {"#declare F=function(x,y,z){x*x*y+sin(z)} #declare G=fn_Gradient(F) ShowN(G(1,2,3)) ShowN(G(0,0,0)) #declare D=fn_Gradient_Directional(F,<1,2,3>) ShowN(D(1,2,3)) ShowV(vGradient(F,<1,2,3>)) ShowN(Gradient_Length(F,<1,2,3>)) ShowN(Gradient_Directional(F,<1,2,3>,<1,1,0>))", "4.240293010704|0.999999833333|0.809807711392|4.000000000,1.000000000,-0.989992332|4.240293010704|3.535533905933"},
    {"#declare F=function(x,y,z){x*x*y+sin(z)} #declare D=fn_Gradient_Directional(F,<0,0,0>) ShowN(D(1,2,3))", "0.000000000000"},
    {"#declare F=function(x,y,z){x*x*y+sin(z)} ShowN(Gradient_Directional(F,<1,2,3>,<0,0,0>))", "0.000000000000"},
    {"#declare F=function{x*x*y+sin(z)} #declare G=function{z*exp(x)} #declare H=function{x*y*z*z} #declare D=fn_Divergence(F,G,H) ShowN(D(1,2,3)) ShowN(Divergence(F,G,H,<1,2,3>)) ShowV(vCurl(F,G,H,<1,2,3>)) ShowN(Divergence(F,G,H,<0.5,-1,2>)) ShowV(vCurl(F,G,H,<.1,.2,.3>))", "15.999999999998|15.999999999998|6.281718172,-18.989992332,7.154846845|-3.000000000000|-1.096170918,0.937336330,0.321551331"},
    {"#declare N=6; #declare A=array[6]{1,2,4,-3,9,2.5} Histogram(A,3) ShowN(dimension_size(HistogramArray,1)) ShowN(dimension_size(HistogramArray,2)) #for(I,0,2) ShowN(HistogramArray[I][0]) ShowN(HistogramArray[I][1]) #end", "3.000000000000|2.000000000000|-1.000000000000|1.000000000000|3.000000000000|4.000000000000|7.000000000000|1.000000000000"},
    {"#declare N=7; #declare A=array[7]{0,1,2,3,4,5,6} Histogram(A,6) #for(I,0,5) ShowN(HistogramArray[I][0]) ShowN(HistogramArray[I][1]) #end", "0.500000000000|1.000000000000|1.500000000000|1.000000000000|2.500000000000|1.000000000000|3.500000000000|1.000000000000|4.500000000000|1.000000000000|5.500000000000|2.000000000000"},
    {"#declare N=7; #declare A=array[7]{0,1,2,3,4,5,6} Histogram(A,1) #for(I,0,0) ShowN(HistogramArray[I][0]) ShowN(HistogramArray[I][1]) #end", "3.000000000000|7.000000000000"},
    {"#declare N=3; #declare A=array[3]{1,2,3} Histogram(A,2.7) ShowN(dimension_size(HistogramArray,1)) #for(I,0,1) ShowN(HistogramArray[I][0]) ShowN(HistogramArray[I][1]) #end", "2.000000000000|1.500000000000|1.000000000000|2.500000000000|2.000000000000"},
    {"ShowV(VPerp_To_Vector(<0,0,1e-12>)) ShowV(VPerp_To_Vector(<0,1e-5,0>)) ShowN(even(2+1e-11)) ShowN(even(2+1e-9)) ShowN(odd(2+1e-11)) ShowN(sgn(select(1e-12,-1,0,1)))", "0.000000000,0.000000000,0.000000000|1.000000000,0.000000000,0.000000000|0.000000000000|0.000000000000|1.000000000000|1.000000000000"},
    {"ShowN(VAngle(<1,2,3>,<3,1,2>)) ShowN(VAngleD(<1,2,3>,<3,-1,2>)) ShowN(VCos_Angle(<1,2,3>,<3,-1,2>)) ShowN(VEq5D(<1,2,3,4,5>,<1,2,3,4,5+1e-11>))", "0.666946344504|60.000000000000|0.500000000000|1.000000000000"},
    {"#declare F=function{x*x+y*z} #declare G=fn_Gradient(F) #declare H=fn_Gradient_Directional(F,x+z) ShowN(G(1,2,3)) ShowN(H(1,2,3))", "4.123105625618|2.828427124746"},
    {"ShowV(VPerp_To_Vector(<0,0,1e-12>)) ShowV(VPerp_To_Vector(<0,1e-5,0>)) ShowN(even(2+1e-11)) ShowN(odd(2+1e-11))", "0.000000000,0.000000000,0.000000000|1.000000000,0.000000000,0.000000000|0.000000000000|1.000000000000"},
    {"#declare A=array[2]{<1,2,3>,<4,6,8>}; ShowV(Mean(A)) #declare B=array[3]{5,5,5}; ShowN(Std_Dev(B,Mean(B)))", "2.500000000,4.000000000,5.500000000|0.000000000000"},
    {"ShowN(VEq(<1,-2,3>,<1,-2,3>)) ShowN(VEq(<1,-2,3>,<1,-2,3+1e-11>)) ShowN(VEq(<1,-2,3>,<1,-2,3+1e-9>)) ShowN(VEq5D(<1,2,3,4,5>,<1,2,3,4,5>)) ShowN(VEq5D(<1,2,3,4,5>,<1,2,3,4,6>)) ShowN(VZero(<0,0,0>)) ShowN(VZero(<0,0,1e-11>)) ShowN(VZero(<0,1e-6,0>)) ShowN(VZero5D(<0,0,0,0,0>)) ShowN(VZero5D(<0,0,0,0,1>))", "1.000000000000|1.000000000000|0.000000000000|1.000000000000|0.000000000000|1.000000000000|1.000000000000|0.000000000000|1.000000000000|0.000000000000"},
    {"ShowN(VMin(<1,2,3>)) ShowN(VMin(<3,1,2>)) ShowN(VMin(<2,3,1>)) ShowN(VMax(<1,2,3>)) ShowN(VMax(<3,1,2>)) ShowN(VMax(<2,3,1>)) ShowV(VWith_Len(<3,4,0>,10)) ShowV(VWith_Len(<3,4,0>,-1))", "1.000000000000|1.000000000000|1.000000000000|3.000000000000|3.000000000000|3.000000000000|6.000000000,8.000000000,0.000000000|-0.600000000,-0.800000000,-0.000000000"},
    {"ShowV(VSqr(<1,-2,3>)) ShowV(VPow(<1,2,3>,3)) ShowC(VPow5D(<1,2,3,4,5>,2)) ShowV(VPow(<1,-2,3>,3)) ShowC(VSqr(<1,2,3,4,5>)) ShowN(VSqr(3))", "1.000000000,4.000000000,9.000000000|1.000000000,8.000000000,27.000000000|1.000000000,4.000000000,9.000000000,16.000000000,25.000000000|1.000000000,-8.000000000,27.000000000|1.000000000,4.000000000,9.000000000,16.000000000,25.000000000|9.000000000000"},
    {"#declare N=6; #declare A=array[6]{1,2,4,-3,9,2.5}; Histogram(A,3) #for(I,0,2) ShowN(HistogramArray[I][0]) ShowN(HistogramArray[I][1]) #end", "-1.000000000000|1.000000000000|3.000000000000|4.000000000000|7.000000000000|1.000000000000"},
    {"SetGradientAccuracy(0.1) #declare F=function{pow(x,4)*y}; #declare H=fn_Gradient_Directional(F,x+z); ShowN(H(1,2,3)) #declare D=fn_Divergence(F,F,F) ShowN(D(1,2,3))", "5.713422791987|9.080000000000"},
    {"ShowN(VAngle(x,<-1,1e-9,0>)) ShowN(VAngleD(<1,1e-9,0>,x)) ShowN(VDist(<1,2,3>,<1,2,3>)) ShowN(VRotationD(<1,0,1>,<1,0,-1>,y))", "3.141592653590|0.000000000000|0.000000000000|90.000000000000"},
    {"SetGradientAccuracy(0.1) #declare F=function{pow(x,4)*y}; ShowN(Gradient_Directional(F,<1,2,3>,<1,2,1>)) #declare HH=fn_Gradient_Directional(F,<-1,2,1>); ShowN(HH(1,2,3))", "4.115142767876|-2.482149606020"},
    {"ShowN(even(4)) ShowN(even(3)) ShowN(even(-2)) ShowN(even(2+1e-11)) ShowN(odd(3)) ShowN(odd(-3)) ShowN(odd(2.5)) ShowN(odd(2+1e-11))", "1.000000000000|0.000000000000|1.000000000000|0.000000000000|1.000000000000|1.000000000000|1.000000000000|1.000000000000"},
    {"ShowN(VLength5D(<1,2,3,4,5>)) ShowN(VDot5D(<1,2,3,4,5>,<5,4,3,2,1>)) ShowN(VLength5D(<0,0,0,0,0>))", "7.416198487096|35.000000000000|0.000000000000"},
};
const Row kTransforms[] = {
    {"#declare LL=spline{natural_spline 0,<1,1,1> 0.5,<3,4,5>, 1,<9,3,-3> 1.5,<2,2,-6>} #declare TT=function{transform{Spline_Trans(LL,0.6,y,0.1,0)}} ShowV(TT(0,0,0)) ShowV(TT(1,2,3))", "4.360000000,4.056000000,4.008000000|5.842257787,5.867627954,1.088939191"},
    {"#declare LL=spline{natural_spline 0,<1,1,1> 0.5,<3,4,5>, 1,<9,3,-3> 1.5,<2,2,-6>} #declare TT=function{transform{Spline_Trans(LL,0.6,y,0.1,0.5)}} ShowV(TT(0,0,0)) ShowV(TT(1,2,3))", "4.360000000,4.056000000,4.008000000|5.727207427,5.781485818,0.982534326"},
    {"#declare LL=spline{natural_spline 0,<1,1,1> 0.5,<3,4,5>, 1,<9,3,-3> 1.5,<2,2,-6>} #declare TT=function{transform{Spline_Trans(LL,0.6,<1,2,0>,0.1,3)}} ShowV(TT(0,0,0)) ShowV(TT(1,2,3))", "4.360000000,4.056000000,4.008000000|5.787313035,5.828455032,1.037952751"},
    {"#declare LL=spline{natural_spline 0,<1,1,1> 0.5,<3,4,5>, 1,<9,3,-3> 1.5,<2,2,-6>} #declare TT=function{transform{Spline_Trans(LL,0.9,z,0.05,-1)}} ShowV(TT(0,0,0)) ShowV(TT(1,2,3))", "8.504000000,3.328000000,-1.336000000|11.654543713,3.177605192,-3.348822822"},
    {"#declare TT=function{transform{Shear_Trans(<1,2,3>,<0,1,0>,<-1,0,2>)}} ShowV(TT(1,2,3)) ShowV(TT(-0.5,0.25,7))", "-2.000000000,4.000000000,9.000000000|-7.500000000,-0.750000000,12.500000000"},
    {"#declare TT=function{transform{Shear_Trans(x,y,z)}} ShowV(TT(1,2,3)) ShowV(TT(-0.5,0.25,7))", "1.000000000,2.000000000,3.000000000|-0.500000000,0.250000000,7.000000000"},
    {"#declare TT=function{transform{Matrix_Trans(<1,2,3>,<0,1,0>,<-1,0,2>,<4,5,6>)}} ShowV(TT(1,2,3)) ShowV(TT(-0.5,0.25,7))", "2.000000000,9.000000000,15.000000000|-3.500000000,4.250000000,18.500000000"},
    {"#declare TT=function{transform{Axial_Scale_Trans(<1,1,0>,2)}} ShowV(TT(1,2,3)) ShowV(TT(-0.5,0.25,7))", "2.500000000,3.500000000,3.000000000|-0.625000000,0.125000000,7.000000000"},
    {"#declare TT=function{transform{Axial_Scale_Trans(3*y,0.5)}} ShowV(TT(1,2,3)) ShowV(TT(-0.5,0.25,7))", "1.000000000,1.000000000,3.000000000|-0.500000000,0.125000000,7.000000000"},
    {"#declare TT=function{transform{Axial_Scale_Trans(<1,2,3>,-1.5)}} ShowV(TT(1,2,3)) ShowV(TT(-0.5,0.25,7))", "-1.500000000,-3.000000000,-4.500000000|-4.250000000,-7.250000000,-4.250000000"},
    {"#declare TT=function{transform{Axial_Scale_Trans(z,3)}} ShowV(TT(1,2,3)) ShowV(TT(-0.5,0.25,7))", "1.000000000,2.000000000,9.000000000|-0.500000000,0.250000000,21.000000000"},
    {"#declare TT=function{transform{Axial_Scale_Trans(-y,3)}} ShowV(TT(1,2,3)) ShowV(TT(-0.5,0.25,7))", "1.000000000,6.000000000,3.000000000|-0.500000000,0.750000000,7.000000000"},
    {"#declare TT=function{transform{Axis_Rotate_Trans(<1,1,0>,40)}} ShowV(TT(1,2,3)) ShowV(TT(-0.5,0.25,7))", "2.480536211,0.519463789,2.752652807|2.769369678,-3.019369678,5.703200710"},
    {"#declare TT=function{transform{Axis_Rotate_Trans(y,-90)}} ShowV(TT(1,2,3)) ShowV(TT(-0.5,0.25,7))", "-3.000000000,2.000000000,1.000000000|-7.000000000,0.250000000,-0.500000000"},
    {"#declare TT=function{transform{Axis_Rotate_Trans(<1,2,3>,400)}} ShowV(TT(1,2,3)) ShowV(TT(-0.5,0.25,7))", "1.000000000,2.000000000,3.000000000|2.244157961,-0.566856045,6.629851376"},
    {"#declare TT=function{transform{Rotate_Around_Trans(<10,20,30>,<1,2,3>)}} ShowV(TT(1,2,3)) ShowV(TT(-0.5,0.25,7))", "1.000000000,2.000000000,3.000000000|2.065089522,-0.177143429,6.929138684"},
    {"#declare TT=function{transform{Rotate_Around_Trans(90*z,<1,1,0>)}} ShowV(TT(1,2,3)) ShowV(TT(-0.5,0.25,7))", "0.000000000,1.000000000,3.000000000|1.750000000,-0.500000000,7.000000000"},
    {"#declare TT=function{transform{Reorient_Trans(x,y)}} ShowV(TT(1,2,3)) ShowV(TT(-0.5,0.25,7))", "-2.000000000,1.000000000,3.000000000|-0.250000000,-0.500000000,7.000000000"},
    {"#declare TT=function{transform{Reorient_Trans(<1,2,3>,<-3,1,1>)}} ShowV(TT(1,2,3)) ShowV(TT(-0.5,0.25,7))", "-3.384456449,1.128152150,1.128152150|-6.125197158,-2.306021757,2.544940753"},
    {"#declare TT=function{transform{Reorient_Trans(x,x)}} ShowV(TT(1,2,3)) ShowV(TT(-0.5,0.25,7))", "1.000000000,2.000000000,3.000000000|-0.500000000,0.250000000,7.000000000"},
    {"#declare TT=function{transform{Reorient_Trans(x,-x)}} ShowV(TT(1,2,3)) ShowV(TT(-0.5,0.25,7))", "-1.000000000,2.000000000,-3.000000000|0.500000000,0.250000000,-7.000000000"},
    {"#declare TT=function{transform{Reorient_Trans(y,-y)}} ShowV(TT(1,2,3)) ShowV(TT(-0.5,0.25,7))", "1.000000000,-2.000000000,-3.000000000|-0.500000000,-0.250000000,-7.000000000"},
    {"#declare TT=function{transform{Reorient_Trans(<1,2,3>,-<1,2,3>)}} ShowV(TT(1,2,3)) ShowV(TT(-0.5,0.25,7))", "-1.000000000,-2.000000000,-3.000000000|0.500000000,-6.365384615,-2.923076923"},
    {"#declare TT=function{transform{Reorient_Trans(<1,2,3>,<2,4,6>)}} ShowV(TT(1,2,3)) ShowV(TT(-0.5,0.25,7))", "1.000000000,2.000000000,3.000000000|-0.500000000,0.250000000,7.000000000"},
    {"#declare TT=function{transform{Reorient_Trans(z,-z)}} ShowV(TT(1,2,3)) ShowV(TT(-0.5,0.25,7))", "1.000000000,-2.000000000,-3.000000000|-0.500000000,-0.250000000,-7.000000000"},
    {"#declare TT=function{transform{Point_At_Trans(x)}} ShowV(TT(1,2,3)) ShowV(TT(-0.5,0.25,7))", "2.000000000,-1.000000000,3.000000000|0.250000000,0.500000000,7.000000000"},
    {"#declare TT=function{transform{Point_At_Trans(z)}} ShowV(TT(1,2,3)) ShowV(TT(-0.5,0.25,7))", "-1.000000000,3.000000000,2.000000000|0.500000000,7.000000000,0.250000000"},
    {"#declare TT=function{transform{Point_At_Trans(<1,2,3>)}} ShowV(TT(1,2,3)) ShowV(TT(-0.5,0.25,7))", "3.425394819,1.456345672,0.381742870|6.812184092,-1.320143570,-1.078827535"},
    {"#declare TT=function{transform{Point_At_Trans(y)}} ShowV(TT(1,2,3)) ShowV(TT(-0.5,0.25,7))", "1.000000000,2.000000000,3.000000000|-0.500000000,0.250000000,7.000000000"},
    {"#declare TT=function{transform{Point_At_Trans(-y)}} ShowV(TT(1,2,3)) ShowV(TT(-0.5,0.25,7))", "-1.000000000,-2.000000000,3.000000000|0.500000000,-0.250000000,7.000000000"},
    {"#declare TT=function{transform{Point_At_Trans(<-1,0.5,2>)}} ShowV(TT(1,2,3)) ShowV(TT(-0.5,0.25,7))", "-1.474528730,3.364135999,0.712989483|1.021234701,6.885854983,-0.924435414"},
    {"#declare T1=transform{rotate <10,20,30> scale <1,2,3> translate <4,5,6>} ShowV(vtransform(<1,2,3>,T1)) ShowV(vinv_transform(<1,2,3>,T1)) ShowV(vtransform(<1,2,3>,transform{translate x})) ShowV(vinv_transform(<1,2,3>,transform{scale <1,2,4>})) ShowV(vtransform(<1,2,3>,transform{scale 2 rotate 90*y}))", "5.067425379,9.578118965,14.281744243|-2.804142366,-0.164113258,-2.088025964|2.000000000,2.000000000,3.000000000|1.000000000,1.000000000,0.750000000|6.000000000,4.000000000,-2.000000000"},
};
const Row kRand[] = {
    {"#declare S1=seed(7); ShowN(rand(RdmA)) ShowN(rand(RdmB)) ShowN(rand(RdmC)) ShowN(rand(RdmD)) ShowN(rand(RdmA))", "0.288036073625|0.689497360189|0.202912715311|0.960339672389|0.780135025685"},
    {"#declare S1=seed(7); ShowN(rand(S1)) ShowN(rand(S1)) ShowN(rand(S1)) ShowN(rand(S1)) ShowN(rand(S1)) ShowN(rand(S1)) ShowN(rand(S1)) ShowN(rand(S1)) ShowN(rand(S1)) ShowN(rand(S1))", "0.953932880646|0.610466280396|0.166852135716|0.034867082498|0.739346577027|0.382975776070|0.482029448841|0.801716349973|0.826195997378|0.795412972056"},
    {"#declare S1=seed(7); ShowN(SRand(S1)) ShowN(SRand(S1)) ShowN(SRand(S1)) ShowN(SRand(S1)) ShowN(SRand(S1))", "0.907865761292|0.220932560791|-0.666295728569|-0.930265835004|0.478693154053"},
    {"#declare S1=seed(7); ShowN(RRand(2,5,S1)) ShowN(RRand(2,5,S1)) ShowN(RRand(2,5,S1)) ShowN(RRand(2,5,S1)) ShowN(RRand(2,5,S1))", "4.861798641938|3.831398841187|2.500556407147|2.104601247493|4.218039731080"},
    {"#declare S1=seed(7); ShowN(RRand(5,2,S1)) ShowN(RRand(5,2,S1)) ShowN(RRand(5,2,S1)) ShowN(RRand(5,2,S1)) ShowN(RRand(5,2,S1))", "2.138201358062|3.168601158813|4.499443592853|4.895398752507|2.781960268920"},
    {"#declare S1=seed(7); ShowV(VRand(S1)) ShowV(VRand(S1)) ShowV(VRand(S1))", "0.953932881,0.610466280,0.166852136|0.034867082,0.739346577,0.382975776|0.482029449,0.801716350,0.826195997"},
    {"#declare S1=seed(7); ShowV(VRand_In_Box(<1,2,3>,<4,-5,6>,S1)) ShowV(VRand_In_Box(<1,2,3>,<4,-5,6>,S1)) ShowV(VRand_In_Box(<1,2,3>,<4,-5,6>,S1))", "3.861798642,-2.273263963,3.500556407|1.104601247,-3.175426039,4.148927328|2.446088347,-3.612014450,5.478587992"},
    {"#declare S1=seed(7); ShowV(VRand_In_Sphere(S1)) ShowV(VRand_In_Sphere(S1)) ShowV(VRand_In_Sphere(S1)) ShowV(VRand_In_Sphere(S1)) ShowN(rand(S1))", "-0.564227048,-0.469560311,-0.655903027|-0.021244669,-0.316906838,-0.076461762|0.189713050,-0.563139334,0.511524548|0.725113138,0.438164438,-0.375099229|0.680121924887"},
    {"#declare S1=seed(7); ShowV(VRand_On_Sphere(S1)) ShowV(VRand_On_Sphere(S1)) ShowV(VRand_On_Sphere(S1)) ShowV(VRand_On_Sphere(S1)) ShowN(rand(S1))", "0.934718528,-0.278370394,0.220932561|0.183072705,0.317946318,-0.930265835|-0.065029652,-0.970047663,-0.234048448|-0.792336139,0.089846647,0.603432700|0.826195997378"},
    {"#declare S1=seed(7); ShowN(Rand_Cauchy(2,3,S1)) ShowN(Rand_Cauchy(2,3,S1)) ShowN(Rand_Cauchy(2,3,S1)) ShowN(Rand_Cauchy(2,3,S1)) ShowN(Rand_Cauchy(2,3,S1)) ShowN(rand(S1))", "22.584167630632|3.085033280312|-3.189167452800|-25.278087394650|4.805620748051|0.382975776070"},
    {"#declare S1=seed(7); ShowN(Rand_Student(4,S1)) ShowN(Rand_Student(4,S1)) ShowN(Rand_Student(4,S1)) ShowN(Rand_Student(4,S1)) ShowN(Rand_Student(4,S1)) ShowN(rand(S1))", "2.093540206586|-0.290073406114|-3.529696778085|0.163026904787|1.798956361017|0.956187681052"},
    {"#declare S1=seed(7); ShowN(Rand_Student(1,S1)) ShowN(Rand_Student(1,S1)) ShowN(Rand_Student(1,S1)) ShowN(Rand_Student(1,S1)) ShowN(Rand_Student(1,S1)) ShowN(rand(S1))", "2.093540206586|-0.290073406114|-3.529696778085|0.163026904787|1.798956361017|0.956187681052"},
    {"#declare S1=seed(7); ShowN(Rand_Student(2.5,S1)) ShowN(Rand_Student(2.5,S1)) ShowN(Rand_Student(2.5,S1)) ShowN(Rand_Student(2.5,S1)) ShowN(Rand_Student(2.5,S1)) ShowN(rand(S1))", "2.340649107777|-0.324311927268|-3.946320967880|0.182269620632|2.011294355894|0.956187681052"},
    {"#declare S1=seed(7); ShowN(Rand_Normal(2,3,S1)) ShowN(Rand_Normal(2,3,S1)) ShowN(Rand_Normal(2,3,S1)) ShowN(Rand_Normal(2,3,S1)) ShowN(Rand_Normal(2,3,S1)) ShowN(rand(S1))", "2.595978948321|1.185395677172|5.221397229538|3.840201933072|1.785654692393|0.990100780267"},
    {"#declare S1=seed(7); ShowN(Rand_Gauss(2,3,S1)) ShowN(Rand_Gauss(2,3,S1)) ShowN(Rand_Gauss(2,3,S1)) ShowN(Rand_Gauss(2,3,S1)) ShowN(Rand_Gauss(2,3,S1)) ShowN(rand(S1))", "5.948159074266|0.824190852821|2.398821087398|2.692641190197|1.802809634929|0.482029448841"},
    {"#declare S1=seed(7); ShowN(Rand_Gamma(2,3,S1)) ShowN(Rand_Gamma(2,3,S1)) ShowN(Rand_Gamma(2,3,S1)) ShowN(Rand_Gamma(2,3,S1)) ShowN(Rand_Gamma(2,3,S1)) ShowN(rand(S1))", "2.371021072593|10.953844733817|5.755986106397|1.538691225062|9.274543173981|0.990100780267"},
    {"#declare S1=seed(7); ShowN(Rand_Gamma(0.5,3,S1)) ShowN(Rand_Gamma(0.5,3,S1)) ShowN(Rand_Gamma(0.5,3,S1)) ShowN(Rand_Gamma(0.5,3,S1)) ShowN(Rand_Gamma(0.5,3,S1)) ShowN(rand(S1))", "6.646983076563|0.117069557576|2.298669694501|0.031470633162|1.945153986752|0.990100780267"},
    {"#declare S1=seed(7); ShowN(Rand_Gamma(1,3,S1)) ShowN(Rand_Gamma(1,3,S1)) ShowN(Rand_Gamma(1,3,S1)) ShowN(Rand_Gamma(1,3,S1)) ShowN(Rand_Gamma(1,3,S1)) ShowN(rand(S1))", "0.141485897178|1.480596659171|5.371941820957|10.068636269305|0.905965460639|0.382975776070"},
    {"#declare S1=seed(7); ShowN(Rand_Gamma(2.5,1,S1)) ShowN(Rand_Gamma(2.5,1,S1)) ShowN(Rand_Gamma(2.5,1,S1)) ShowN(Rand_Gamma(2.5,1,S1)) ShowN(Rand_Gamma(2.5,1,S1)) ShowN(rand(S1))", "1.118780404293|4.210486950200|2.411705423287|0.769341555747|3.645366173786|0.990100780267"},
    {"#declare S1=seed(7); ShowN(Rand_Beta(2,3,S1)) ShowN(Rand_Beta(2,3,S1)) ShowN(Rand_Beta(2,3,S1)) ShowN(Rand_Beta(2,3,S1)) ShowN(Rand_Beta(2,3,S1)) ShowN(rand(S1))", "0.141831873722|0.647280831197|0.636615383816|0.215843249198|0.516980344281|0.060600451208"},
    {"#declare S1=seed(7); ShowN(Rand_Beta(.5,.7,S1)) ShowN(Rand_Beta(.5,.7,S1)) ShowN(Rand_Beta(.5,.7,S1)) ShowN(Rand_Beta(.5,.7,S1)) ShowN(Rand_Beta(.5,.7,S1)) ShowN(rand(S1))", "0.953747271874|0.396958050748|0.002596601953|0.403170717580|0.186949028679|0.536204926794"},
    {"#declare S1=seed(7); ShowN(Rand_Chi_Square(3,S1)) ShowN(Rand_Chi_Square(3,S1)) ShowN(Rand_Chi_Square(3,S1)) ShowN(Rand_Chi_Square(3,S1)) ShowN(Rand_Chi_Square(3,S1)) ShowN(rand(S1))", "1.185510536296|5.476922366908|2.877993053198|0.769345612531|4.637271586990|0.990100780267"},
    {"#declare S1=seed(7); ShowN(Rand_Chi_Square(4,S1)) ShowN(Rand_Chi_Square(4,S1)) ShowN(Rand_Chi_Square(4,S1)) ShowN(Rand_Chi_Square(4,S1)) ShowN(Rand_Chi_Square(4,S1)) ShowN(rand(S1))", "1.580680715062|7.302563155878|3.837324070931|1.025794150041|6.183028782654|0.990100780267"},
    {"#declare S1=seed(7); ShowN(Rand_Chi_Square(1,S1)) ShowN(Rand_Chi_Square(1,S1)) ShowN(Rand_Chi_Square(1,S1)) ShowN(Rand_Chi_Square(1,S1)) ShowN(Rand_Chi_Square(1,S1)) ShowN(rand(S1))", "0.395170178765|1.825640788969|0.959331017733|0.256448537510|1.545757195663|0.990100780267"},
    {"#declare S1=seed(7); ShowN(Rand_F_Dist(3,4,S1)) ShowN(Rand_F_Dist(3,4,S1)) ShowN(Rand_F_Dist(3,4,S1)) ShowN(Rand_F_Dist(3,4,S1)) ShowN(Rand_F_Dist(3,4,S1)) ShowN(rand(S1))", "0.384809961792|6.650368847551|5.451827066474|0.737696711827|3.196843785256|0.060600451208"},
    {"#declare S1=seed(7); ShowN(Rand_Erlang(2,3,S1)) ShowN(Rand_Erlang(2,3,S1)) ShowN(Rand_Erlang(2,3,S1)) ShowN(Rand_Erlang(2,3,S1)) ShowN(Rand_Erlang(2,3,S1)) ShowN(rand(S1))", "4.662682918204|9.235968232614|2.283347460553|7.776935424813|2.293796928122|0.559032304110"},
    {"#declare S1=seed(7); ShowN(Rand_Erlang(2,1,S1)) ShowN(Rand_Erlang(2,1,S1)) ShowN(Rand_Erlang(2,1,S1)) ShowN(Rand_Erlang(2,1,S1)) ShowN(Rand_Erlang(2,1,S1)) ShowN(rand(S1))", "0.094323931452|0.987064439448|3.581294547305|6.712424179536|0.603976973759|0.382975776070"},
    {"#declare S1=seed(7); ShowN(Rand_Exp(2,S1)) ShowN(Rand_Exp(2,S1)) ShowN(Rand_Exp(2,S1)) ShowN(Rand_Exp(2,S1)) ShowN(Rand_Exp(2,S1)) ShowN(rand(S1))", "0.023580982863|0.246766109862|0.895323636826|1.678106044884|0.150994243440|0.382975776070"},
    {"#declare S1=seed(7); ShowN(Rand_Lognormal(1,0.5,S1)) ShowN(Rand_Lognormal(1,0.5,S1)) ShowN(Rand_Lognormal(1,0.5,S1)) ShowN(Rand_Lognormal(1,0.5,S1)) ShowN(Rand_Lognormal(1,0.5,S1)) ShowN(rand(S1))", "5.248941894456|2.234531996955|2.905106879615|3.050910889620|2.630397404520|0.482029448841"},
    {"#declare S1=seed(7); ShowN(Rand_Lognormal(2,3,S1)) ShowN(Rand_Lognormal(2,3,S1)) ShowN(Rand_Lognormal(2,3,S1)) ShowN(Rand_Lognormal(2,3,S1)) ShowN(Rand_Lognormal(2,3,S1)) ShowN(rand(S1))", "383.047527536423|2.280035134739|11.010188676278|14.770636506981|6.066668665723|0.482029448841"},
    {"#declare S1=seed(7); ShowN(Rand_Pareto(2,S1)) ShowN(Rand_Pareto(2,S1)) ShowN(Rand_Pareto(2,S1)) ShowN(Rand_Pareto(2,S1)) ShowN(Rand_Pareto(2,S1)) ShowN(rand(S1))", "1.023861212602|1.279879726522|2.448127965632|5.355403466170|1.162989963241|0.382975776070"},
    {"#declare S1=seed(7); ShowN(Rand_Weibull(2,3,S1)) ShowN(Rand_Weibull(2,3,S1)) ShowN(Rand_Weibull(2,3,S1)) ShowN(Rand_Weibull(2,3,S1)) ShowN(Rand_Weibull(2,3,S1)) ShowN(rand(S1))", "0.722593352198|1.580526684130|2.428659762630|2.994422850007|1.341817518651|0.382975776070"},
    {"#declare S1=seed(7); ShowN(Rand_Bernoulli(0.4,S1)) ShowN(Rand_Bernoulli(0.4,S1)) ShowN(Rand_Bernoulli(0.4,S1)) ShowN(Rand_Bernoulli(0.4,S1)) ShowN(Rand_Bernoulli(0.4,S1)) ShowN(rand(S1))", "0.000000000000|0.000000000000|1.000000000000|1.000000000000|0.000000000000|0.382975776070"},
    {"#declare S1=seed(7); ShowN(Prob(0.4,S1)) ShowN(Prob(0.4,S1)) ShowN(Prob(0.4,S1)) ShowN(Prob(0.4,S1)) ShowN(Prob(0.4,S1))", "0.000000000000|0.000000000000|1.000000000000|1.000000000000|0.000000000000"},
    {"#declare S1=seed(7); ShowN(Prob(1,S1)) ShowN(Prob(1,S1)) ShowN(Prob(1,S1)) ShowN(Prob(1,S1)) ShowN(Prob(1,S1))", "1.000000000000|1.000000000000|1.000000000000|1.000000000000|1.000000000000"},
    {"#declare S1=seed(7); ShowN(Prob(0,S1)) ShowN(Prob(0,S1)) ShowN(Prob(0,S1)) ShowN(Prob(0,S1)) ShowN(Prob(0,S1))", "0.000000000000|0.000000000000|0.000000000000|0.000000000000|0.000000000000"},
    {"#declare S1=seed(7); ShowN(Rand_Binomial(10,0.4,S1)) ShowN(Rand_Binomial(10,0.4,S1)) ShowN(Rand_Binomial(10,0.4,S1)) ShowN(Rand_Binomial(10,0.4,S1)) ShowN(Rand_Binomial(10,0.4,S1)) ShowN(rand(S1))", "3.000000000000|4.000000000000|1.000000000000|4.000000000000|5.000000000000|0.406328984165"},
    {"#declare S1=seed(7); ShowN(Rand_Binomial(3,0.4,S1)) ShowN(Rand_Binomial(3,0.4,S1)) ShowN(Rand_Binomial(3,0.4,S1)) ShowN(Rand_Binomial(3,0.4,S1)) ShowN(Rand_Binomial(3,0.4,S1)) ShowN(rand(S1))", "1.000000000000|2.000000000000|0.000000000000|2.000000000000|0.000000000000|0.559032304110"},
    {"#declare S1=seed(7); ShowN(Rand_Binomial(1,0.4,S1)) ShowN(Rand_Binomial(1,0.4,S1)) ShowN(Rand_Binomial(1,0.4,S1)) ShowN(Rand_Binomial(1,0.4,S1)) ShowN(Rand_Binomial(1,0.4,S1)) ShowN(rand(S1))", "0.000000000000|0.000000000000|1.000000000000|1.000000000000|0.000000000000|0.382975776070"},
    {"#declare S1=seed(7); ShowN(Rand_Geo(0.3,S1)) ShowN(Rand_Geo(0.3,S1)) ShowN(Rand_Geo(0.3,S1)) ShowN(Rand_Geo(0.3,S1)) ShowN(Rand_Geo(0.3,S1)) ShowN(rand(S1))", "0.000000000000|1.000000000000|5.000000000000|9.000000000000|0.000000000000|0.382975776070"},
    {"#declare S1=seed(7); ShowN(Rand_Poisson(4,S1)) ShowN(Rand_Poisson(4,S1)) ShowN(Rand_Poisson(4,S1)) ShowN(Rand_Poisson(4,S1)) ShowN(Rand_Poisson(4,S1)) ShowN(rand(S1))", "4.000000000000|7.000000000000|6.000000000000|6.000000000000|8.000000000000|0.851130450110"},
    {"#declare S1=seed(7); ShowN(Rand_Poisson(0.5,S1)) ShowN(Rand_Poisson(0.5,S1)) ShowN(Rand_Poisson(0.5,S1)) ShowN(Rand_Poisson(0.5,S1)) ShowN(Rand_Poisson(0.5,S1)) ShowN(rand(S1))", "2.000000000000|1.000000000000|1.000000000000|2.000000000000|1.000000000000|0.801716349973"},
    {"#declare S1=seed(7); ShowN(Rand_Poisson(40,S1)) ShowN(Rand_Poisson(40,S1)) ShowN(Rand_Poisson(40,S1)) ShowN(Rand_Poisson(40,S1)) ShowN(Rand_Poisson(40,S1)) ShowN(rand(S1))", "47.000000000000|33.000000000000|41.000000000000|45.000000000000|35.000000000000|0.218964188643"},
    {"#declare S1=seed(7); ShowN(Rand_F_Dist(1,1,S1)) ShowN(Rand_F_Dist(1,1,S1)) ShowN(Rand_F_Dist(1,1,S1))", "0.216455603508|3.740832476747|3.066652724892"},
    {"#declare S1=seed(7); ShowN(Rand_F_Dist(2,5,S1)) ShowN(Rand_F_Dist(2,5,S1)) ShowN(Rand_F_Dist(2,5,S1))", "1.352847521926|23.380202979672|19.166579530572"},
    {"#declare S1=seed(7); ShowN(Rand_F_Dist(5,2,S1)) ShowN(Rand_F_Dist(5,2,S1)) ShowN(Rand_F_Dist(5,2,S1))", "0.034632896561|0.598533196280|0.490664435983"},
    {"#declare S1=seed(7); ShowN(Rand_F_Dist(1,2,S1)) ShowN(Rand_F_Dist(1,2,S1)) ShowN(Rand_F_Dist(1,2,S1))", "0.865822414033|14.963329906990|12.266610899566"},
    {"#declare S1=seed(7); ShowN(Rand_F_Dist(2,1,S1)) ShowN(Rand_F_Dist(2,1,S1)) ShowN(Rand_F_Dist(2,1,S1))", "0.054113900877|0.935208119187|0.766663181223"},
    {"#declare S1=seed(7); ShowN(Rand_F_Dist(1,10,S1)) ShowN(Rand_F_Dist(1,10,S1)) ShowN(Rand_F_Dist(1,10,S1))", "21.645560350815|374.083247674750|306.665272489157"},
    {"#declare S1=seed(7); ShowN(Rand_Chi_Square(2.7,S1)) ShowN(Rand_Chi_Square(2.7,S1)) ShowN(Rand_Chi_Square(2.7,S1))", "0.790340357531|3.651281577939|1.918662035466"},
    {"#declare S1=seed(7); ShowN(Rand_Binomial(3.7,0.5,S1)) ShowN(Rand_Binomial(3.7,0.5,S1)) ShowN(Rand_Binomial(3.7,0.5,S1)) ShowN(rand(S1))", "1.000000000000|2.000000000000|1.000000000000|0.795412972056"},
    {"#declare S1=seed(7); ShowN(Rand_Binomial(0,0.5,S1)) ShowN(Rand_Binomial(0,0.5,S1)) ShowN(Rand_Binomial(0,0.5,S1))", "0.000000000000|0.000000000000|0.000000000000"},
    {"#declare S1=seed(7); ShowN(Rand_Erlang(2,2.5,S1)) ShowN(Rand_Erlang(2,2.5,S1)) ShowN(Rand_Erlang(2,2.5,S1)) ShowN(rand(S1))", "4.662682918204|9.235968232614|2.283347460553|0.795412972056"},
    {"#declare S1=seed(7); ShowN(Rand_Erlang(2,0,S1)) ShowN(Rand_Erlang(2,0,S1)) ShowN(Rand_Erlang(2,0,S1)) ShowN(rand(S1))", "-0.000000000000|-0.000000000000|-0.000000000000|0.953932880646"},
    {"#declare S1=seed(7); ShowN(Rand_Geo(0,S1)) ShowN(Rand_Geo(0,S1)) ShowN(Rand_Geo(0,S1))", "inf|inf|inf"},
    {"#declare S1=seed(7); ShowN(Rand_Poisson(0,S1)) ShowN(Rand_Poisson(0,S1)) ShowN(Rand_Poisson(0,S1)) ShowN(rand(S1))", "0.000000000000|0.000000000000|0.000000000000|0.953932880646"},
    {"#declare S1=seed(7); ShowN(Rand_Exp(0,S1)) ShowN(Rand_Exp(0,S1))", "inf|inf"},
    {"#declare S1=seed(7); ShowN(Rand_Gauss(0,1,S1)) #declare S2=seed(9); ShowN(Rand_Gauss(0,1,S2)) ShowN(Rand_Gauss(0,1,S2)) ShowN(rand(S2))", "1.316053024755|-0.391936382393|0.430585905632|0.000504109077"},
    {"#declare S1=seed(7); #declare S2=seed(9); ShowN(Rand_Gauss(0,1,S1)) ShowN(Rand_Gauss(0,1,S2)) ShowN(Rand_Gauss(0,1,S2)) ShowN(rand(S1)) ShowN(rand(S2))", "1.316053024755|-0.391936382393|0.430585905632|0.166852135716|0.000504109077"},
    {"#declare S1=seed(7); ShowN(Rand_Gamma(1.0001,2,S1)) ShowN(Rand_Gamma(7,0.5,S1)) ShowN(Rand_Beta(1,1,S1)) ShowN(Rand_Student(10,S1)) ShowN(Rand_Normal(0,0,S1)) ShowN(rand(S1))", "0.400638735196|4.673560908196|0.767551617083|1.620554880765|0.000000000000|0.990100780267"},
    {"#declare S1=seed(7); ShowN(Rand_Binomial(100,0.02,S1)) ShowN(Rand_Geo(0.9,S1)) ShowN(Rand_Poisson(2,S1)) ShowN(Rand_Bernoulli(1,S1)) ShowN(Rand_Bernoulli(0,S1)) ShowN(rand(S1))", "1.000000000000|0.000000000000|2.000000000000|1.000000000000|0.000000000000|0.386119149017"},
};
const Row kStrings[] = {
    {"#declare CC=rgb <1,.5,.25>; #declare CF=rgbft <1,.5,.25,.125,2>; ShowS(CRGBStr(CC,0,2)) ShowS(CRGBStr(CC,0,-1)) ShowS(CRGBFTStr(CF,0,3)) ShowS(CRGBFTStr(CC,6,1)) ShowS(CRGBStr(CF,-6,1))", "color rgb <   1.00, 0.50, 0.25>|color rgb <   1.000000, 0.500000, 0.250000>|color rgbft < 1.000, 0.500, 0.250, 0.125, 2.000>|color rgbft <    1.0,    0.5,    0.2,    0.0,    0.0>|color rgb <   0001.0, 0000.5, 0000.2>"},
    {"ShowS(Str(1.5)) ShowS(Str(pi)) ShowS(Str(-1e10)) ShowS(VStr2D(<1,2.5>)) ShowS(VStr(<1,2,-3>)) ShowS(Vstr2D(<1,2>,0,2)) ShowS(Vstr(<1,2,3>,6,2)) ShowS(Vstr(<1,2,3>,-6,1)) ShowS(VStr(x)) ShowS(Str(0))", "1.500000|3.141593|-10000000000.000000|<1.000000,2.500000>|<1.000000,2.000000,-3.000000>|<1.00,2.00>|<  1.00,  2.00,  3.00>|<0001.0,0002.0,0003.0>|<1.000000,0.000000,0.000000>|0.000000"},
    {"ShowS(VStr2D(<1,2,3>))", "<1.000000,2.000000>"},
    {"ShowS(VStr(<1,2>))", "<1.000000,2.000000,0.000000>"},
    {"#declare X=Triangle_Str(<1,2,3>,<4,5,6>,<7,8,9.5>); ShowS(substr(X,1,60)) ShowS(substr(X,61,strlen(X)-60)) ShowN(strlen(X))", "triangle {<1.000000,2.000000,3.000000>,<4.000000,5.000000,6.|000000>,<7.000000,8.000000,9.500000>}|97.000000000000"},
    {"#declare X=Smooth_Triangle_Str(<1,2,3>,x,<4,5,6>,y,<7,8,9.5>,z); ShowS(substr(X,1,60)) ShowS(substr(X,61,60)) ShowS(substr(X,121,strlen(X)-120)) ShowN(strlen(X))", "smooth_triangle {<1.000000,2.000000,3.000000>,<1.000000,0.00|0000,0.000000>,<4.000000,5.000000,6.000000>,<0.000000,1.0000|00,0.000000>,<7.000000,8.000000,9.500000>,<0.000000,0.000000,1.000000>}|191.000000000000"},
};
const Row kArrays[] = {
    {"#macro L(A) #for(I,0,dimension_size(A,1)-1) ShowN(A[I]) #end #end #declare B=array[4]{4,1,3,2} Resize_Array(B,6) ShowN(dimension_size(B,1)) ShowN(B[3]) #declare B[5]=9; ShowN(B[5])", "6.000000000000|2.000000000000|9.000000000000"},
    {"#macro L(A) #for(I,0,dimension_size(A,1)-1) ShowN(A[I]) #end #end #declare B=array[4]{4,1,3,2} Resize_Array(B,2) ShowN(dimension_size(B,1)) L(B)", "2.000000000000|4.000000000000|1.000000000000"},
    {"#macro L(A) #for(I,0,dimension_size(A,1)-1) ShowN(A[I]) #end #end #declare B=array[4]{4,1,3,2} Reverse_Array(B) L(B)", "2.000000000000|3.000000000000|1.000000000000|4.000000000000"},
    {"#macro L(A) #for(I,0,dimension_size(A,1)-1) ShowN(A[I]) #end #end #declare B=array[5]{4,1,3,2,7} Reverse_Array(B) L(B)", "7.000000000000|2.000000000000|3.000000000000|1.000000000000|4.000000000000"},
    {"#macro L(A) #for(I,0,dimension_size(A,1)-1) ShowN(A[I]) #end #end #declare B=array[4]{4,1,3,2} Sort_Array(B) L(B)", "1.000000000000|2.000000000000|3.000000000000|4.000000000000"},
    {"#macro L(A) #for(I,0,dimension_size(A,1)-1) ShowN(A[I]) #end #end #declare B=array[6]{4,1,3,2,0,-1} Sort_Partial_Array(B,1,4) L(B)", "4.000000000000|0.000000000000|1.000000000000|2.000000000000|3.000000000000|-1.000000000000"},
    {"#macro L(A) #for(I,0,dimension_size(A,1)-1) ShowN(A[I]) #end #end #declare B=array[4]{4,1,3,2} ShowN(Sort_Compare(B,0,1)) ShowN(Sort_Compare(B,1,0)) ShowN(Sort_Compare(B,1,1)) Sort_Swap_Data(B,0,3) L(B)", "0.000000000000|1.000000000000|0.000000000000|2.000000000000|1.000000000000|3.000000000000|4.000000000000"},
    {"#macro L(A) #for(I,0,dimension_size(A,1)-1) ShowN(A[I]) #end #end #declare B=array[1]{4} Sort_Array(B) Reverse_Array(B) L(B)", "4.000000000000"},
    {"#macro L(A) #for(I,0,dimension_size(A,1)-1) ShowN(A[I]) #end #end #declare B=array[2][2]{{4,5},{1,3}} #macro Sort_Compare(A,I,J) (A[I][0]<A[J][0]) #end #macro Sort_Swap_Data(A,I,J) #for(K,0,1) #local T=A[I][K]; #declare A[I][K]=A[J][K]; #declare A[J][K]=T; #end #end Sort_Array(B) ShowN(B[0][0]) ShowN(B[0][1]) ShowN(B[1][1])", "1.000000000000|3.000000000000|5.000000000000"},
    {"#macro L(A) #for(I,0,dimension_size(A,1)-1) ShowN(A[I]) #end #end #declare B=array[3]{<1,2,3>,<0,1,2>,x} Reverse_Array(B) ShowV(B[0])", "1.000000000,0.000000000,0.000000000"},
    {"#macro L(A) #for(I,0,dimension_size(A,1)-1) ShowN(A[I]) #end #end #declare B=array[5] #declare B[0]=1; #declare B[2]=3; Resize_Array(B,4) #ifdef(B[1]) ShowN(1) #else ShowN(0) #end #ifdef(B[2]) ShowN(B[2]) #end", "0.000000000000|3.000000000000"},
    {"#macro L(A) #for(I,0,dimension_size(A,1)-1) ShowN(A[I]) #end #end #declare B=array[8]{4,1,3,2,4,1,3,2} Sort_Array(B) L(B)", "1.000000000000|1.000000000000|2.000000000000|2.000000000000|3.000000000000|3.000000000000|4.000000000000|4.000000000000"},
    {"#macro L(A) #for(I,0,dimension_size(A,1)-1) ShowN(A[I]) #end #end #declare B=array[6]{4,1,3,2,0,-1} Sort_Partial_Array(B,3,3) Sort_Partial_Array(B,0,1) L(B)", "1.000000000000|4.000000000000|3.000000000000|2.000000000000|0.000000000000|-1.000000000000"},
};
const Row kConsts[] = {
    {"ShowN(Plane_Map) ShowN(Sphere_Map) ShowN(Cylinder_Map) ShowN(Torus_Map) ShowN(Bi) ShowN(Norm) ShowN(Uniform_Fog) ShowN(Ground_Fog) ShowN(Hex_Blur1) ShowN(Hex_Blur2) ShowN(Hex_Blur3)", "0.000000000000|1.000000000000|2.000000000000|5.000000000000|2.000000000000|4.000000000000|1.000000000000|2.000000000000|7.000000000000|19.000000000000|37.000000000000"},
    {"ShowN(Air_Ior) ShowN(Amethyst_Ior) ShowN(Apatite_Ior) ShowN(Aquamarine_Ior) ShowN(Beryl_Ior) ShowN(Citrine_Ior) ShowN(Crown_Glass_Ior) ShowN(Corundum_Ior) ShowN(Diamond_Ior) ShowN(Emerald_Ior) ShowN(Flint_Glass_Ior) ShowN(Flint_Glass_Heavy_Ior) ShowN(Flint_Glass_Medium_Ior) ShowN(Flint_Glass_Light_Ior)", "1.000292000000|1.550000000000|1.635000000000|1.575000000000|1.575000000000|1.550000000000|1.510000000000|1.765000000000|2.470000000000|1.575000000000|1.710000000000|1.800000000000|1.630000000000|1.600000000000"},
    {"ShowN(Fluorite_Ior) ShowN(Gypsum_Ior) ShowN(Ice_Ior) ShowN(Plexiglas_Ior) ShowN(Quartz_Ior) ShowN(Quartz_Glass_Ior) ShowN(Ruby_Ior) ShowN(Salt_Ior) ShowN(Sapphire_Ior) ShowN(Topaz_Ior) ShowN(Tourmaline_Ior) ShowN(Water_Ior)", "1.434000000000|1.525000000000|1.310000000000|1.500000000000|1.550000000000|1.458000000000|1.765000000000|1.544000000000|1.765000000000|1.620000000000|1.650000000000|1.330000000000"},
    {"ShowN(Quartz_Glass_Dispersion) ShowN(Water_Dispersion) ShowN(Diamond_Dispersion) ShowN(Sapphire_Dispersion) ShowN(ISOTROPIC_SCATTERING) ShowN(MIE_HAZY_SCATTERING) ShowN(MIE_MURKY_SCATTERING) ShowN(RAYLEIGH_SCATTERING) ShowN(HENYEY_GREENSTEIN_SCATTERING) ShowV(o) ShowV(xy) ShowV(yz) ShowV(xz)", "1.012000000000|1.007000000000|1.035000000000|1.015000000000|1.000000000000|2.000000000000|3.000000000000|4.000000000000|5.000000000000|0.000000000,0.000000000,0.000000000|1.000000000,1.000000000,0.000000000|0.000000000,1.000000000,1.000000000|1.000000000,0.000000000,1.000000000"},
};
const Row kColors[] = {
    {"ShowC(CRGB2HSL(<-1,-2,-3>))", "30.000000000,-0.500000000,-2.000000000,0.000000000,0.000000000"},
};

// POV-Ray keeps vectors of five components in single precision: equal to 3e-7.
const Row kMathSingle[] = {
    {"ShowN(VLength5D(<1,2,3,4,5>)) ShowC(VNormalize5D(<1,2,3,4,5>)) ShowN(VDot5D(<1,2,3,4,5>,<5,4,3,2,1>)) ShowN(VLength5D(<0,0,0,0,0>))", "7.416198487096|0.134839967,0.269679934,0.404519916,0.539359868,0.674199879|35.000000000000|0.000000000000"},
    {"ShowC(VNormalize5D(<1,2,3,4,5>)) ShowC(VNormalize5D(<-1,0,0,0,1>))", "0.134839967,0.269679934,0.404519916,0.539359868,0.674199879|-0.707106769,0.000000000,0.000000000,0.000000000,0.707106769"},
};
const Row kColorsSingle[] = {
    {"ShowC(CHSL2RGB(<120,1,0.5>)) ShowC(CHSL2RGB(<200,0.3,0.7>)) ShowC(CHSL2RGB(<0,0,0.7>)) ShowC(CHSL2RGB(<-60,0.5,0.3>)) ShowC(CHSL2RGB(<400,0.5,0.3>)) ShowC(CHSL2RGB(<60,1,0.25,0.1,0.2>)) ShowC(CHSL2RGB(<300,2,0.25>)) ShowC(CHSL2RGB(<180,1,1>)) ShowC(CHSL2RGB(<240,1,0>)) ShowC(CHSL2RGB(<359.9,0.9,0.6>)) ShowC(CHSL2RGB(<360,0.9,0.6>)) ShowC(CHSL2RGB(<59,0.9,1.6>))", "0.000000000,1.000000000,0.000000000,0.000000000,0.000000000|0.609999955,0.730000019,0.790000021,0.000000000,0.000000000|0.699999988,0.699999988,0.699999988,0.000000000,0.000000000|0.450000018,0.150000006,0.450000018,0.000000000,0.000000000|0.450000018,0.350000024,0.150000006,0.000000000,0.000000000|0.500000000,0.500000000,0.000000000,0.100000001,0.200000003|0.750000000,-0.250000000,0.750000000,0.000000000,0.000000000|1.000000000,1.000000000,1.000000000,0.000000000,0.000000000|0.000000000,0.000000000,0.000000000,0.000000000,0.000000000|0.959999979,0.240000054,0.241200134,0.000000000,0.000000000|0.959999979,0.240000054,0.240000054,0.000000000,0.000000000|1.060000062,1.078000069,2.140000105,0.000000000,0.000000000"},
    {"ShowC(CRGB2HSL(<0,1,0>)) ShowC(CRGB2HSL(<0.2,0.5,0.7>)) ShowC(CRGB2HSL(<0.5,0.5,0.5>)) ShowC(CRGB2HSL(<0,0,0>)) ShowC(CRGB2HSL(<1,1,1>)) ShowC(CRGB2HSL(<1,0,0.5>)) ShowC(CRGB2HSL(<0.1,0.2,0.3,0.4,0.5>)) ShowC(CRGB2HSL(Orange)) ShowC(CRGB2HSL(<2,0.5,1>)) ShowC(CRGB2HSL(<-0.1,0.5,0.2>)) ShowC(CRGB2HSL(<1,0.2,0.5>)) ShowC(CRGB2HSL(<1,1,0.5>)) ShowC(CRGB2HSL(<1,0,1>)) ShowC(CRGB2HSL(<0,1,1>))", "120.000000000,1.000000000,0.500000000,0.000000000,0.000000000|204.000000000,0.555555522,0.449999988,0.000000000,0.000000000|0.000000000,0.000000000,0.500000000,0.000000000,0.000000000|0.000000000,0.000000000,0.000000000,0.000000000,0.000000000|0.000000000,0.000000000,1.000000000,0.000000000,0.000000000|-30.000000000,1.000000000,0.500000000,0.000000000,0.000000000|210.000000000,0.500000000,0.200000003,0.400000006,0.500000000|30.000000000,1.000000000,0.500000000,0.000000000,0.000000000|-20.000000000,-3.000000000,1.250000000,0.000000000,0.000000000|150.000000000,1.500000000,0.200000003,0.000000000,0.000000000|-22.500000000,1.000000000,0.600000024,0.000000000,0.000000000|60.000000000,1.000000000,0.750000000,0.000000000,0.000000000|-60.000000000,1.000000000,0.500000000,0.000000000,0.000000000|180.000000000,1.000000000,0.500000000,0.000000000,0.000000000"},
    {"ShowC(CHSV2RGB(<120,1,0.5>)) ShowC(CHSV2RGB(<200,0.3,0.7>)) ShowC(CHSV2RGB(<0,0,0.7>)) ShowC(CHSV2RGB(<-60,0.5,0.3>)) ShowC(CHSV2RGB(<400,0.5,0.3>)) ShowC(CHSV2RGB(<60,1,0.25,0.1,0.2>)) ShowC(CHSV2RGB(<300,2,0.25>)) ShowC(CHSV2RGB(<360,0.4,1.5>)) ShowC(CHSV2RGB(<240,0.4,0>)) ShowC(CHSV2RGB(<240,0.4,1>)) ShowC(CHSV2RGB(<300,0.4,1>)) ShowC(CHSV2RGB(<330,0.4,1>))", "0.000000000,0.500000000,0.000000000,0.000000000,0.000000000|0.489999980,0.629999995,0.699999988,0.000000000,0.000000000|0.699999988,0.699999988,0.699999988,0.000000000,0.000000000|0.300000012,0.150000006,0.300000012,0.000000000,0.000000000|0.300000012,0.250000000,0.150000006,0.000000000,0.000000000|0.250000000,0.250000000,0.000000000,0.100000001,0.200000003|0.250000000,-0.250000000,0.250000000,0.000000000,0.000000000|1.500000000,0.899999976,0.899999976,0.000000000,0.000000000|0.000000000,0.000000000,0.000000000,0.000000000,0.000000000|0.600000024,0.600000024,1.000000000,0.000000000,0.000000000|1.000000000,0.600000024,1.000000000,0.000000000,0.000000000|1.000000000,0.600000024,0.800000012,0.000000000,0.000000000"},
    {"ShowC(CRGB2HSV(<0,1,0>)) ShowC(CRGB2HSV(<0.2,0.5,0.7>)) ShowC(CRGB2HSV(<0.5,0.5,0.5>)) ShowC(CRGB2HSV(<0,0,0>)) ShowC(CRGB2HSV(<1,0,0.5>)) ShowC(CRGB2HSV(<0.1,0.2,0.3,0.4,0.5>)) ShowC(CRGB2HSV(<2,0.5,1>)) ShowC(CRGB2HSV(<1,1,0>)) ShowC(CRGB2HSV(<1,0,1>)) ShowC(CRGB2HSV(<0,1,1>)) ShowC(CRGB2HSV(<-1,-2,-3>))", "120.000000000,1.000000000,1.000000000,0.000000000,0.000000000|204.000000000,0.714285731,0.699999988,0.000000000,0.000000000|0.000000000,0.000000000,0.500000000,0.000000000,0.000000000|0.000000000,0.000000000,0.000000000,0.000000000,0.000000000|-30.000000000,1.000000000,1.000000000,0.000000000,0.000000000|210.000000000,0.666666687,0.300000012,0.400000006,0.500000000|-20.000000000,0.750000000,2.000000000,0.000000000,0.000000000|60.000000000,1.000000000,1.000000000,0.000000000,0.000000000|-60.000000000,1.000000000,1.000000000,0.000000000,0.000000000|180.000000000,1.000000000,1.000000000,0.000000000,0.000000000|30.000000000,-2.000000000,-1.000000000,0.000000000,0.000000000"},
    {"ShowC(CHSL2RGB(<720,1,.5>)) ShowC(CHSL2RGB(<-420,1,.25>)) ShowC(CHSL2RGB(<1,1,.5>))", "1.000000000,0.000000000,0.000000000,0.000000000,0.000000000|0.500000000,0.000000000,0.500000000,0.000000000,0.000000000|1.000000000,0.016666668,0.000000000,0.000000000,0.000000000"},
    {"ShowC(CHSL2RGB(rgb <120,1,.5>)) ShowC(CRGB2HSL(Red)) ShowC(CRGB2HSV(Salmon)) ShowC(CHSV2RGB(rgbft<120,1,.5,.1,.2>))", "0.000000000,1.000000000,0.000000000,0.000000000,0.000000000|0.000000000,1.000000000,0.500000000,0.000000000,0.000000000|0.000000000,0.405404180,0.435294002,0.000000000,0.000000000|0.000000000,0.500000000,0.000000000,0.100000001,0.200000003"},
    {"ShowC(Red) ShowC(Green) ShowC(Blue) ShowC(Yellow) ShowC(Cyan) ShowC(Magenta) ShowC(Clear) ShowC(White) ShowC(Black) ShowC(Gray05)", "1.000000000,0.000000000,0.000000000,0.000000000,0.000000000|0.000000000,1.000000000,0.000000000,0.000000000,0.000000000|0.000000000,0.000000000,1.000000000,0.000000000,0.000000000|1.000000000,1.000000000,0.000000000,0.000000000,0.000000000|0.000000000,1.000000000,1.000000000,0.000000000,0.000000000|1.000000000,0.000000000,1.000000000,0.000000000,0.000000000|1.000000000,1.000000000,1.000000000,1.000000000,0.000000000|1.000000000,1.000000000,1.000000000,0.000000000,0.000000000|0.000000000,0.000000000,0.000000000,0.000000000,0.000000000|0.050000001,0.050000001,0.050000001,0.000000000,0.000000000"},
    {"ShowC(Gray10) ShowC(Gray15) ShowC(Gray20) ShowC(Gray25) ShowC(Gray30) ShowC(Gray35) ShowC(Gray40) ShowC(Gray45) ShowC(Gray50) ShowC(Gray55)", "0.100000001,0.100000001,0.100000001,0.000000000,0.000000000|0.150000006,0.150000006,0.150000006,0.000000000,0.000000000|0.200000003,0.200000003,0.200000003,0.000000000,0.000000000|0.250000000,0.250000000,0.250000000,0.000000000,0.000000000|0.300000012,0.300000012,0.300000012,0.000000000,0.000000000|0.349999994,0.349999994,0.349999994,0.000000000,0.000000000|0.400000006,0.400000006,0.400000006,0.000000000,0.000000000|0.449999988,0.449999988,0.449999988,0.000000000,0.000000000|0.500000000,0.500000000,0.500000000,0.000000000,0.000000000|0.550000012,0.550000012,0.550000012,0.000000000,0.000000000"},
    {"ShowC(Gray60) ShowC(Gray65) ShowC(Gray70) ShowC(Gray75) ShowC(Gray80) ShowC(Gray85) ShowC(Gray90) ShowC(Gray95) ShowC(DimGray) ShowC(DimGrey)", "0.600000024,0.600000024,0.600000024,0.000000000,0.000000000|0.649999976,0.649999976,0.649999976,0.000000000,0.000000000|0.699999988,0.699999988,0.699999988,0.000000000,0.000000000|0.750000000,0.750000000,0.750000000,0.000000000,0.000000000|0.800000012,0.800000012,0.800000012,0.000000000,0.000000000|0.850000024,0.850000024,0.850000024,0.000000000,0.000000000|0.899999976,0.899999976,0.899999976,0.000000000,0.000000000|0.949999988,0.949999988,0.949999988,0.000000000,0.000000000|0.329412013,0.329412013,0.329412013,0.000000000,0.000000000|0.329412013,0.329412013,0.329412013,0.000000000,0.000000000"},
    {"ShowC(Gray) ShowC(Grey) ShowC(LightGray) ShowC(LightGrey) ShowC(VLightGray) ShowC(VLightGrey) ShowC(Aquamarine) ShowC(BlueViolet) ShowC(Brown) ShowC(CadetBlue)", "0.752941012,0.752941012,0.752941012,0.000000000,0.000000000|0.752941012,0.752941012,0.752941012,0.000000000,0.000000000|0.658824027,0.658824027,0.658824027,0.000000000,0.000000000|0.658824027,0.658824027,0.658824027,0.000000000,0.000000000|0.800000012,0.800000012,0.800000012,0.000000000,0.000000000|0.800000012,0.800000012,0.800000012,0.000000000,0.000000000|0.439215988,0.858824015,0.576470971,0.000000000,0.000000000|0.623520017,0.372548997,0.623529017,0.000000000,0.000000000|0.647059023,0.164706007,0.164706007,0.000000000,0.000000000|0.372548997,0.623529017,0.623529017,0.000000000,0.000000000"},
    {"ShowC(Coral) ShowC(CornflowerBlue) ShowC(DarkGreen) ShowC(DarkOliveGreen) ShowC(DarkOrchid) ShowC(DarkSlateBlue) ShowC(DarkSlateGray) ShowC(DarkSlateGrey) ShowC(DarkTurquoise) ShowC(Firebrick)", "1.000000000,0.498039007,0.000000000,0.000000000,0.000000000|0.258823991,0.258823991,0.435294002,0.000000000,0.000000000|0.184313998,0.309803993,0.184313998,0.000000000,0.000000000|0.309803993,0.309803993,0.184313998,0.000000000,0.000000000|0.600000024,0.196078002,0.800000012,0.000000000,0.000000000|0.119608000,0.137254998,0.556863010,0.000000000,0.000000000|0.184313998,0.309803993,0.309803993,0.000000000,0.000000000|0.184313998,0.309803993,0.309803993,0.000000000,0.000000000|0.439215988,0.576470971,0.858824015,0.000000000,0.000000000|0.556863010,0.137254998,0.137254998,0.000000000,0.000000000"},
    {"ShowC(ForestGreen) ShowC(Gold) ShowC(Goldenrod) ShowC(GreenYellow) ShowC(IndianRed) ShowC(Khaki) ShowC(LightBlue) ShowC(LightSteelBlue) ShowC(LimeGreen) ShowC(Maroon)", "0.137254998,0.556863010,0.137254998,0.000000000,0.000000000|0.800000012,0.498039007,0.196078002,0.000000000,0.000000000|0.858824015,0.858824015,0.439215988,0.000000000,0.000000000|0.576470971,0.858824015,0.439215988,0.000000000,0.000000000|0.309803993,0.184313998,0.184313998,0.000000000,0.000000000|0.623529017,0.623529017,0.372548997,0.000000000,0.000000000|0.749019980,0.847059011,0.847059011,0.000000000,0.000000000|0.560783982,0.560783982,0.737254977,0.000000000,0.000000000|0.196078002,0.800000012,0.196078002,0.000000000,0.000000000|0.556863010,0.137254998,0.419607997,0.000000000,0.000000000"},
    {"ShowC(MediumAquamarine) ShowC(MediumBlue) ShowC(MediumForestGreen) ShowC(MediumGoldenrod) ShowC(MediumOrchid) ShowC(MediumSeaGreen) ShowC(MediumSlateBlue) ShowC(MediumSpringGreen) ShowC(MediumTurquoise) ShowC(MediumVioletRed)", "0.196078002,0.800000012,0.600000024,0.000000000,0.000000000|0.196078002,0.196078002,0.800000012,0.000000000,0.000000000|0.419607997,0.556863010,0.137254998,0.000000000,0.000000000|0.917647004,0.917647004,0.678430974,0.000000000,0.000000000|0.576470971,0.439215988,0.858824015,0.000000000,0.000000000|0.258823991,0.435294002,0.258823991,0.000000000,0.000000000|0.498039007,0.000000000,1.000000000,0.000000000,0.000000000|0.498039007,1.000000000,0.000000000,0.000000000,0.000000000|0.439215988,0.858824015,0.858824015,0.000000000,0.000000000|0.858824015,0.439215988,0.576470971,0.000000000,0.000000000"},
    {"ShowC(MidnightBlue) ShowC(Navy) ShowC(NavyBlue) ShowC(Orange) ShowC(OrangeRed) ShowC(Orchid) ShowC(PaleGreen) ShowC(Pink) ShowC(Plum) ShowC(Salmon)", "0.184313998,0.184313998,0.309803993,0.000000000,0.000000000|0.137254998,0.137254998,0.556863010,0.000000000,0.000000000|0.137254998,0.137254998,0.556863010,0.000000000,0.000000000|1.000000000,0.500000000,0.000000000,0.000000000,0.000000000|1.000000000,0.250000000,0.000000000,0.000000000,0.000000000|0.858824015,0.439215988,0.858824015,0.000000000,0.000000000|0.560783982,0.737254977,0.560783982,0.000000000,0.000000000|0.737254977,0.560783982,0.560783982,0.000000000,0.000000000|0.917647004,0.678430974,0.917647004,0.000000000,0.000000000|0.435294002,0.258823991,0.258823991,0.000000000,0.000000000"},
    {"ShowC(SeaGreen) ShowC(Sienna) ShowC(SkyBlue) ShowC(SlateBlue) ShowC(SpringGreen) ShowC(SteelBlue) ShowC(Tan) ShowC(Thistle) ShowC(Turquoise) ShowC(Violet)", "0.137254998,0.556863010,0.419607997,0.000000000,0.000000000|0.556863010,0.419607997,0.137254998,0.000000000,0.000000000|0.196078002,0.600000024,0.800000012,0.000000000,0.000000000|0.000000000,0.498039007,1.000000000,0.000000000,0.000000000|0.000000000,1.000000000,0.498039007,0.000000000,0.000000000|0.137254998,0.419607997,0.556863010,0.000000000,0.000000000|0.858824015,0.576470971,0.439215988,0.000000000,0.000000000|0.847059011,0.749019980,0.847059011,0.000000000,0.000000000|0.678430974,0.917647004,0.917647004,0.000000000,0.000000000|0.309803993,0.184313998,0.309803993,0.000000000,0.000000000"},
    {"ShowC(VioletRed) ShowC(Wheat) ShowC(YellowGreen) ShowC(SummerSky) ShowC(RichBlue) ShowC(Brass) ShowC(Copper) ShowC(Bronze) ShowC(Bronze2) ShowC(Silver)", "0.800000012,0.196078002,0.600000024,0.000000000,0.000000000|0.847059011,0.847059011,0.749019980,0.000000000,0.000000000|0.600000024,0.800000012,0.196078002,0.000000000,0.000000000|0.219999999,0.689999998,0.870000005,0.000000000,0.000000000|0.349999994,0.349999994,0.670000017,0.000000000,0.000000000|0.709999979,0.649999976,0.259999990,0.000000000,0.000000000|0.720000029,0.449999988,0.200000003,0.000000000,0.000000000|0.550000012,0.469999999,0.140000001,0.000000000,0.000000000|0.649999976,0.490000010,0.239999995,0.000000000,0.000000000|0.899999976,0.910000026,0.980000019,0.000000000,0.000000000"},
    {"ShowC(BrightGold) ShowC(OldGold) ShowC(Feldspar) ShowC(Quartz) ShowC(Mica) ShowC(NeonPink) ShowC(DarkPurple) ShowC(NeonBlue) ShowC(CoolCopper) ShowC(MandarinOrange)", "0.850000024,0.850000024,0.100000001,0.000000000,0.000000000|0.810000002,0.709999979,0.230000004,0.000000000,0.000000000|0.819999993,0.569999993,0.460000008,0.000000000,0.000000000|0.850000024,0.850000024,0.949999988,0.000000000,0.000000000|0.000000000,0.000000000,0.000000000,0.000000000,0.000000000|1.000000000,0.430000007,0.779999971,0.000000000,0.000000000|0.529999971,0.119999997,0.469999999,0.000000000,0.000000000|0.300000012,0.300000012,1.000000000,0.000000000,0.000000000|0.850000024,0.529999971,0.100000001,0.000000000,0.000000000|0.889999986,0.469999999,0.200000003,0.000000000,0.000000000"},
    {"ShowC(LightWood) ShowC(MediumWood) ShowC(DarkWood) ShowC(SpicyPink) ShowC(SemiSweetChoc) ShowC(BakersChoc) ShowC(Flesh) ShowC(NewTan) ShowC(NewMidnightBlue) ShowC(VeryDarkBrown)", "0.910000026,0.759999990,0.649999976,0.000000000,0.000000000|0.649999976,0.500000000,0.389999986,0.000000000,0.000000000|0.519999981,0.370000005,0.259999990,0.000000000,0.000000000|1.000000000,0.109999999,0.680000007,0.000000000,0.000000000|0.419999987,0.259999990,0.150000006,0.000000000,0.000000000|0.360000014,0.200000003,0.090000004,0.000000000,0.000000000|0.959999979,0.800000012,0.689999998,0.000000000,0.000000000|0.920000017,0.779999971,0.620000005,0.000000000,0.000000000|0.000000000,0.000000000,0.610000014,0.000000000,0.000000000|0.349999994,0.159999996,0.140000001,0.000000000,0.000000000"},
    {"ShowC(DarkBrown) ShowC(DarkTan) ShowC(GreenCopper) ShowC(DkGreenCopper) ShowC(DustyRose) ShowC(HuntersGreen) ShowC(Scarlet) ShowC(Med_Purple) ShowC(Light_Purple) ShowC(Very_Light_Purple)", "0.360000014,0.250000000,0.200000003,0.000000000,0.000000000|0.589999974,0.409999996,0.310000002,0.000000000,0.000000000|0.319999993,0.490000010,0.460000008,0.000000000,0.000000000|0.289999992,0.460000008,0.430000007,0.000000000,0.000000000|0.519999981,0.389999986,0.389999986,0.000000000,0.000000000|0.129999995,0.370000005,0.310000002,0.000000000,0.000000000|0.550000012,0.090000004,0.090000004,0.000000000,0.000000000|0.730000019,0.159999996,0.959999979,0.000000000,0.000000000|0.870000005,0.579999983,0.980000019,0.000000000,0.000000000|0.939999998,0.810000002,0.990000010,0.000000000,0.000000000"},
};
// clang-format on

Options withLibrary() {
  Options options;
  options.includePaths = {std::string(VESTIGE_SOURCE_DIR) + "/library"};
  return options;
}

std::string included(const char* file) { return std::string("#include \"") + file + ".inc\"\n"; }

/// The lines that begin with '@', without it, joined by '|'; then what else was said: errors.
std::string shown(const std::string& text) {
  std::string lines, rest;
  std::istringstream said(debugOf(text, withLibrary()));
  for (std::string line; std::getline(said, line);) {
    if (!line.empty() && line[0] == '@')
      lines.append(lines.empty() ? "" : "|").append(line, 1, line.npos);
    else
      rest += line;
  }
  return lines + rest;
}

std::string resultOf(const char* file, const Row& row) {
  return shown(kPrelude + included(file) + row.text);
}

template <std::size_t N>
void checkExact(const char* file, const Row (&rows)[N]) {
  for (const Row& row : rows) {
    INFO(row.text);
    CHECK(resultOf(file, row) == row.expected);
  }
}

template <std::size_t N>
void checkNear(const char* file, const Row (&rows)[N]) {
  for (const Row& row : rows) {
    const std::string result = resultOf(file, row);
    INFO(row.text);
    INFO(result);
    INFO(row.expected);
    CHECK(isNear(result, row.expected, 3e-7));
  }
}

}  // namespace

TEST_CASE("math.inc has POV-Ray's results", "[lang]") { checkExact("math", kMath); }
TEST_CASE("transforms.inc has POV-Ray's results", "[lang]") {
  checkExact("transforms", kTransforms);
}
TEST_CASE("rand.inc has POV-Ray's results", "[lang]") { checkExact("rand", kRand); }
TEST_CASE("strings.inc has POV-Ray's results", "[lang]") { checkExact("strings", kStrings); }
TEST_CASE("arrays.inc has POV-Ray's results", "[lang]") { checkExact("arrays", kArrays); }
TEST_CASE("consts.inc has POV-Ray's results", "[lang]") { checkExact("consts", kConsts); }
TEST_CASE("colors.inc has POV-Ray's results", "[lang]") { checkExact("colors", kColors); }
TEST_CASE("colours have POV-Ray's values", "[lang]") { checkNear("colors", kColorsSingle); }
TEST_CASE("vectors of five components have POV-Ray's values", "[lang]") {
  checkNear("math", kMathSingle);
}

TEST_CASE("the comparison of the library's rows sees differences", "[lang]") {
  CHECK(isNear("1.0000000,2|x", "1.0000001,2|x", 3e-7));
  CHECK_FALSE(isNear("1.000000,2|x", "1.000001,2|x", 3e-7));
  CHECK_FALSE(isNear("1,2", "1,2,3", 3e-7));
  CHECK_FALSE(isNear("1|", "1,", 3e-7));
  CHECK_FALSE(isNear("1.0", " 1.0", 3e-7));
  CHECK_FALSE(isNear("  1", "001", 3e-7));
  CHECK_FALSE(isNear("nan", "1.0", 3e-7));
}

// POV-Ray's manual describes these; its files do not have them, or stop with an error.
TEST_CASE("what POV-Ray's manual describes and its files lack", "[lang]") {
  const auto is = [](const char* file, const std::string& text) {
    return shown(kPrelude + included(file) + text);
  };
  // The inverse of the distribution function, for the three first numbers of the stream.
  const double u[] = {0.953932880646, 0.610466280396, 0.166852135716};
  std::string expected;
  for (double each : u) {
    const double peak = 0.25;
    const double number =
        each < peak ? 1 + 4 * std::sqrt(each * peak) : 5 - 4 * std::sqrt((1 - each) * (1 - peak));
    char digits[32];
    std::snprintf(digits, sizeof digits, "%.12f", number);
    expected.append(expected.empty() ? "" : "|").append(digits);
  }
  CHECK(isNear(is("rand", "#declare R = seed(7); #for (I, 1, 3) ShowN(Rand_Tri(1, 5, 2, R)) #end"),
               expected, 2e-6));
  CHECK(is("colors", "ShowV(Convert_Color(\"HSL\", \"HSV\", <120, 1, 0.5>))") ==
        "120.000000000,1.000000000,1.000000000");
  CHECK(is("colors", "ShowV(Convert_Color(\"RGB\", \"RGB\", <0.25, 1, 0.5>))") ==
        "0.250000000,1.000000000,0.500000000");
  CHECK_THAT(is("colors", "ShowV(Convert_Color(\"XYZ\", \"RGB\", 1))"),
             containsText("converts \"RGB\", \"HSL\" and \"HSV\", found XYZ"));
  CHECK(is("math",
           "#declare A = array[3] {5, 5, 5}; Histogram(A, 2) "
           "ShowN(HistogramArray[0][1]) ShowN(HistogramArray[1][1])") ==
        "3.000000000000|0.000000000000");
  CHECK_THAT(is("strings", "Parse_String(\"1\")"), containsText("Parse_String()"));
}

TEST_CASE("the library's files can be included twice and together", "[lang]") {
  std::string text = kPrelude;
  for (int round = 0; round < 2; ++round)
    for (const char* file : {"colors", "consts", "math", "transforms", "rand", "arrays", "strings"})
      text += included(file);
  const Result r = read(text + "ShowN(1)", withLibrary());
  INFO(printed(r));
  CHECK(r.diagnostics.list().empty());
}

TEST_CASE("a declaration goes to its own table, not to the macro's that its value ends with",
          "[lang]") {
  CHECK(shown(std::string(kPrelude) + "#macro M() #local H = 5; function(x, y, z) { x + H } #end "
                                      "#declare H = M() ShowN(H(1, 2, 3))") == "6.000000000000");
}

}  // namespace vestige::lang::test
