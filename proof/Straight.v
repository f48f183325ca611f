(* SPDX-License-Identifier: MIT *)
(* Elbow.v takes logarithms, and 0 has none. So straight and folded arms, of which a factor is 0, are a case of their
   own. *)
From Coq Require Import Reals Lra Psatz.
From Swivel Require Import Rotors Products Elbow.
Open Scope R_scope.

Lemma bent_straight c L1 L2 : c <> 0 -> bent c 0 L1 L2 = v3 0 0 (L1 + L2).
Proof. intro H. unfold bent, vadd, rot, sand, vscale, q2n; simpl. f_equal; field; nra. Qed.
Lemma bent_folded s L1 L2 : s <> 0 -> bent 0 s L1 L2 = v3 0 0 (L1 - L2).
Proof. intro H. unfold bent, vadd, rot, sand, vscale, q2n; simpl. f_equal; field; nra. Qed.
Lemma lift_id sg lc z : sg = 1 \/ sg = -1 -> lc <> 0 -> rot (lift_q sg lc 0) (v3 0 0 z) = v3 0 0 (sg * z).
Proof. intros [->| ->] H; unfold lift_q; destruct (Rlt_dec _ 0); try lra; unfold rot, sand, vscale, q2n; simpl;
  f_equal; field; nra. Qed.
Lemma lift_pi sg ls z : sg = 1 \/ sg = -1 -> ls <> 0 -> rot (lift_q sg 0 ls) (v3 0 0 z) = v3 0 0 (sg * - z).
Proof. intros [->| ->] H; unfold lift_q; destruct (Rlt_dec _ 0); try lra; unfold rot, sand, vscale, q2n; simpl;
  f_equal; field; nra. Qed.
Lemma vnorm_z sg a b : sg = 1 \/ sg = -1 -> vnorm (vsub (v3 0 0 (sg * a)) (v3 0 0 (sg * b))) = Rabs (a - b).
Proof. intro H. unfold vnorm, v2n, vsub; simpl.
  replace ((0-0)*(0-0) + (0-0)*(0-0) + (sg*a - sg*b)*(sg*a - sg*b)) with (Rsqr (a - b)) by (destruct H as [->| ->];
    unfold Rsqr; ring).
  apply sqrt_Rsqr_abs. Qed.

Section Edge.
Variables (u F D d : R) (e1 e2 e3 e4 e5 e6 e7 e8 e9 e10 e11 e12 e13 e14 r : R).
Hypothesis Hu : 0 <= u < 1/2.
Hypotheses (H1 : Rabs e1 <= u) (H2 : Rabs e2 <= u) (H3 : Rabs e3 <= u) (H4 : Rabs e4 <= u) (H5 : Rabs e5 <= u)
  (H6 : Rabs e6 <= u) (H7 : Rabs e7 <= u) (H8 : Rabs e8 <= u) (H9 : Rabs e9 <= u) (H10 : Rabs e10 <= u)
  (H11 : Rabs e11 <= u) (H12 : Rabs e12 <= u) (H13 : Rabs e13 <= u) (H14 : Rabs e14 <= u).
Hypothesis Hr : 0 < r.
Let P := p F D d e2 e4 e7.
Let M := m F D d e1 e3 e8.
Let CH := ch D d e1 e2 e5 e9 e11 r.
Let SH := sh F d e3 e4 e6 e10 e12 r.
Let SM := smaller F D d e1 e2 e3 e4 e5 e6 e9 e10 e11 e12 e13 r.

Theorem elbow L1 L2 sg : 0 < d -> Rabs D <= d -> d <= F -> Rabs D < F -> sg = 1 \/ sg = -1 ->
  forall lc ls, (M <= P /\ lc = larger e14 r P /\ ls = SM) \/ (P <= M /\ lc = SM /\ ls = larger e14 r M) ->
  (CH <> 0 \/ SH <> 0) /\ (lc <> 0 \/ ls <> 0) /\
  vnorm (vsub (rot (lift_q sg lc ls) (bent CH SH L1 L2)) (v3 0 0 (sg * d)))
    <= 9 * (u / (1 - u)) * F + (Rabs (L1 - (F+D)/2) + Rabs (L2 - (F-D)/2)).
Proof.
  intros Hd HD HF HDF Hsg lc ls Hl.
  assert (HK : 0 <= 9 * (u / (1-u)) * F).
  { apply Rmult_le_pos; [|lra]. apply Rmult_le_pos; [lra|]. apply Rmult_le_pos; [lra|]. left. apply Rinv_0_lt_compat.
    lra. }
  assert (N : forall e, Rabs e <= u -> 0 < 1 + e). { intros e He. destruct Hu as [U1 U2]. clear -He U1 U2.
    unfold Rabs in He; destruct (Rcase_abs e); lra. }
  pose proof (N _ H1) as N1. pose proof (N _ H2) as N2. pose proof (N _ H3) as N3. pose proof (N _ H4) as N4.
    pose proof (N _ H5) as N5. pose proof (N _ H6) as N6. pose proof (N _ H7) as N7.
  pose proof (N _ H8) as N8. pose proof (N _ H9) as N9. pose proof (N _ H10) as N10. pose proof (N _ H11) as N11.
    pose proof (N _ H12) as N12. pose proof (N _ H13) as N13. pose proof (N _ H14) as N14.
  assert (DD : - F < D < F) by (clear -HDF; unfold Rabs in HDF; destruct (Rcase_abs D); lra).
  assert (D2 : - d <= D <= d) by (clear -HD; unfold Rabs in HD; destruct (Rcase_abs D); lra).
  destruct (Req_dec d F) as [EF|NF].
  { (* straight *)
    assert (Esh : SH = 0). { unfold SH, sh, b, shorter. rewrite EF.
      replace ((F - F) * (1+e3) * longer F F e4 * (1+e6) * r * (1+e10)) with 0 by ring. rewrite sqrt_0. ring. }
    assert (Em : M = 0). { unfold M, m, shorter. rewrite EF. ring. }
    assert (Esm : SM = 0). { unfold SM, smaller. fold SH. rewrite Esh. ring. }
    assert (Pp : 0 < P). { unfold P, p, ahead, longer. rewrite EF. repeat apply Rmult_lt_0_compat; try assumption; lra.
      }
    assert (Pc : 0 < CH). { unfold CH, ch, a, behind, ahead. rewrite EF.
      apply Rmult_lt_0_compat; [apply sqrt_lt_R0|assumption]. repeat apply Rmult_lt_0_compat; try assumption; lra. }
    destruct Hl as [[_ [-> ->]]|[Q _]]; [|lra].
    assert (Pl : 0 < larger e14 r P) by (unfold larger; apply Rmult_lt_0_compat; [apply Rmult_lt_0_compat|];
      assumption).
    split; [left; lra|split; [left; lra|]].
    rewrite Esh, Esm, bent_straight, lift_id, vnorm_z by (try assumption; lra). rewrite EF.
    assert (Rabs (L1 + L2 - F) <= Rabs (L1 - (F+D)/2) + Rabs (L2 - (F-D)/2)).
    { replace (L1 + L2 - F) with ((L1 - (F+D)/2) + (L2 - (F-D)/2)) by field. apply Rabs_triang. }
    lra. }
  destruct (Req_dec (Rabs D) d) as [ED|ND].
  { (* folded *)
    assert (Pb : 0 < SH). { unfold SH, sh, b, shorter, longer. apply Rmult_lt_0_compat; [apply sqrt_lt_R0|assumption].
      repeat apply Rmult_lt_0_compat; try assumption; lra. }
    destruct (Rle_lt_dec 0 D) as [S|S].
    - assert (Ed : d = D) by (rewrite Rabs_right in ED; lra).
      assert (Ech : CH = 0). { unfold CH, ch, a, behind. rewrite Ed.
        replace ((D - D) * (1+e1) * ahead D D e2 * (1+e5) * r * (1+e9)) with 0 by ring. rewrite sqrt_0. ring. }
      assert (Em : M = 0). { unfold M, m, behind. rewrite Ed. ring. }
      assert (Esm : SM = 0). { unfold SM, smaller. fold CH. rewrite Ech. ring. }
      assert (Pp : 0 < P). { unfold P, p, ahead, longer. repeat apply Rmult_lt_0_compat; try assumption; lra. }
      destruct Hl as [[_ [-> ->]]|[Q _]]; [|lra].
      assert (Pl : 0 < larger e14 r P) by (unfold larger; apply Rmult_lt_0_compat; [apply Rmult_lt_0_compat|];
        assumption).
      split; [right; lra|split; [left; lra|]].
      rewrite Ech, Esm, bent_folded, lift_id, vnorm_z by (try assumption; lra). rewrite Ed.
      assert (Rabs (L1 - L2 - D) <= Rabs (L1 - (F+D)/2) + Rabs (L2 - (F-D)/2)).
      { replace (L1 - L2 - D) with ((L1 - (F+D)/2) + - (L2 - (F-D)/2)) by field. eapply Rle_trans. apply Rabs_triang.
        rewrite Rabs_Ropp. lra. }
      lra.
    - assert (Ed : d = - D) by (rewrite Rabs_left in ED; lra).
      assert (Ech : CH = 0). { unfold CH, ch, a, ahead. rewrite Ed.
        replace (behind D (-D) e1 * ((-D + D) * (1+e2)) * (1+e5) * r * (1+e9)) with 0 by ring. rewrite sqrt_0. ring. }
      assert (Ep : P = 0). { unfold P, p, ahead. rewrite Ed. ring. }
      assert (Esm : SM = 0). { unfold SM, smaller. fold CH. rewrite Ech. ring. }
      assert (Pm : 0 < M). { unfold M, m, behind, shorter. repeat apply Rmult_lt_0_compat; try assumption; lra. }
      destruct Hl as [[Q _]|[_ [-> ->]]]; [lra|].
      assert (Pl : 0 < larger e14 r M) by (unfold larger; apply Rmult_lt_0_compat; [apply Rmult_lt_0_compat|];
        assumption).
      split; [right; lra|split; [right; lra|]].
      rewrite Ech, Esm, bent_folded, lift_pi, vnorm_z by (try assumption; lra). rewrite Ed.
      assert (Rabs (- (L1 - L2) - - D) <= Rabs (L1 - (F+D)/2) + Rabs (L2 - (F-D)/2)).
      { replace (- (L1 - L2) - - D) with (- (L1 - (F+D)/2) + (L2 - (F-D)/2)) by field. eapply Rle_trans.
        apply Rabs_triang. rewrite Rabs_Ropp. lra. }
      lra. }
  assert (D3 : Rabs D < d) by lra.
  assert (Q : 0 < CH /\ 0 < SH).
  { assert (- d < D < d) by (clear -D3; unfold Rabs in D3; destruct (Rcase_abs D); lra).
    split; [unfold CH, ch, a, behind, ahead|unfold SH, sh, b, shorter, longer]; (apply Rmult_lt_0_compat;
      [apply sqrt_lt_R0|assumption]); repeat apply Rmult_lt_0_compat; try assumption; lra. }
  destruct Q as [Q1 Q2].
  assert (Qsm : 0 < SM) by (unfold SM, smaller; fold CH; fold SH; apply Rmult_lt_0_compat; [apply Rmult_lt_0_compat|];
    assumption).
  split; [left; lra|]. split. { destruct Hl as [[_ [-> ->]]|[_ [-> ->]]]; [right|left]; lra. }
  unfold CH, SH.
  refine (elbow_inner u F D d e1 e2 e3 e4 e5 e6 e7 e8 e9 e10 e11 e12 e13 e14 r Hu H1 H2 H3 H4 H5 H6 H7 H8 H9 H10 H11
    H12 H13 H14 Hr L1 L2 sg Hd D3 _ Hsg lc ls _).
  lra. destruct Hl as [[_ Q]|[_ Q]]; [left|right]; exact Q.
Qed.
End Edge.
